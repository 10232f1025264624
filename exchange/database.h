#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "replay/table/value.h"
#include "replay/trace_reader.h"

namespace reprise::exchange {

/// A trace as an SQL database: the tables of replay::Table, read where a statement looks and never
/// copied as a whole, so that hours fit into some megabytes. A condition on `tick` reads only these
/// ticks. Enumerators are their names, truth is 1 or 0, whole numbers above 2^63 are decimal texts.
class Database {
  public:
    /// The reader must outlive it, and is used by it alone.
    explicit Database(replay::TraceReader& trace);
    ~Database();
    Database(const Database&) = delete;
    Database& operator=(const Database&) = delete;

    using Columns = std::function<void(const std::vector<std::string>&)>;
    using Row = std::function<void(std::span<const replay::Value>)>;

    /// Runs one reading statement. Throws world::Error that says what is wrong with it.
    void query(const std::string& sql, const Columns& columns, const Row& row);

    /// The tables and their columns, a line for each.
    std::string tables() const;

  private:
    struct Connection;
    std::unique_ptr<Connection> connection_;
};

}  // namespace reprise::exchange

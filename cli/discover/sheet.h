#pragma once

#include <string>
#include <variant>
#include <vector>

namespace reprise::cli {

/// A table of things of one kind, for people and for programs.
class Sheet {
  public:
    struct Column {
        std::string heading;  ///< for people, with its unit: "length [m]"
        std::string key;      ///< in JSON: "length"; SI but for a unit in its end
        int digits = 2;       ///< behind the point, of reals, for people
    };

    /// Nothing is "-" for people and null in JSON.
    using Cell = std::variant<std::monostate, std::string, double, std::int64_t, bool>;

    explicit Sheet(std::vector<Column> columns) : columns_(std::move(columns)) {}

    void add(std::vector<Cell> row) { rows_.push_back(std::move(row)); }

    /// Keeps the rows in which a cell, as people see it, holds the text. Capitals do not count.
    void keep(const std::string& text);

    std::size_t size() const { return rows_.size(); }

    /// Aligned, numbers to the right, with headings; lines end without blanks.
    std::string text() const;

    /// A list of objects.
    std::string json() const;

  private:
    std::string shown(const Cell& cell, const Column& column) const;

    std::vector<Column> columns_;
    std::vector<std::vector<Cell>> rows_;
};

}  // namespace reprise::cli

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "replay/table/derived.h"
#include "replay/table/selection.h"
#include "replay/table/value.h"
#include "replay/trace_reader.h"

namespace reprise::replay {

/// A trace as a table: a row for every element that a list of the ticks has (vehicles, cars,
/// events, ...), or, in the table `ticks`, for every tick. The columns come from the schemas: tick,
/// time [s], then the fields, position.x as position_x; of a plain list its place and its value.
/// Behind them, where they make sense: name, model_name, length, width, lane_name. How far along
/// its lane something is, both tables tell of the same two points: rear_axle_s and front_s, that of
/// the front bumper (on a straight line ahead of the axle).
class Table {
  public:
    static std::vector<std::string> names();

    /// Whether its rows lie in /sim/traffic.
    static bool is_of_traffic(const std::string& name);

    /// Whether its rows belong to actors.
    static bool has_actors(const std::string& name);

    /// Throws world::Error for a table or field that there is not. What `names` borrows must
    /// outlive it; without them the columns with names of actors and lanes are missing.
    Table(const std::string& name,
          const Selection& selection,
          std::uint64_t step_ns,
          const TableNames& names = {});
    ~Table();
    Table(Table&&) noexcept;
    Table& operator=(Table&&) noexcept;

    const std::string& name() const;
    const std::vector<std::string>& columns() const;

    /// Calls `row` for every row of this tick, in order. The values live until it returns.
    void read(const RecordedTick& tick,
              const std::function<void(std::span<const Value>)>& row) const;

  private:
    struct Plan;
    std::unique_ptr<Plan> plan_;
};

/// The one table that all selected fields are of. Throws world::Error when they are of several.
std::string table_of(const Selection& selection);

/// The table's first line, with units, and a tick's lines.
void append_csv_header(const Table& table, std::string& out);
void append_csv(const Table& table, const RecordedTick& tick, std::string& out);

}  // namespace reprise::replay

// Private to the room: columns of a table that no tick records, but a reader wants to see: names of
// actors, models and lanes, lengths, and both reference points along a lane.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "replay/recorded_tick.h"
#include "replay/table/value.h"
#include "world/story/crashes.h"
#include "world/town_generated.h"

namespace reprise::replay {

/// Who and where things are, for names in tables. Both may be null: those columns are left out.
struct TableNames {
    const world::TownT* town = nullptr;
    const world::ActorNames* actors = nullptr;  ///< of all ticks until the one that is read
};

/// A column that is worked out.
struct Derived {
    std::string name;
    /// `element` is a row's struct or table.
    Value (*value)(const TableNames&, const RecordedTick&, const void* element) = nullptr;
};

/// Those of this table; of a selection of fields only the actor's name.
std::vector<Derived> derived_columns(std::string_view table,
                                     const TableNames& names,
                                     bool whole_table);

/// The column of a recorded field: as the field, but `lane_s` tells of which point it is.
std::string column_of_field(std::string_view table, std::string column);

/// "speed [m/s]" for speed: the heading of a column in files that people read.
std::string with_unit(const std::string& column);

}  // namespace reprise::replay

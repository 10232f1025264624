#pragma once

#include <string>
#include <vector>

#include "replay/table/value.h"
#include "replay/trace_reader.h"

namespace reprise::replay {

/// A table that has no row for each tick: what stands behind the numbers in the others.
struct WholeTable {
    std::string name;
    std::vector<std::string> columns;
    std::vector<std::vector<Value>> rows;
};

/// lanes and actors.
const std::vector<std::string>& whole_table_names();

/// One of these two.
WholeTable read_whole_table(TraceReader& trace, const std::string& name);

/// The town's lanes; `number` is what the other tables call `lane`. Neighbours and the junction at
/// its end by name; OpenDRIVE's road, lane and s where the town came from it.
WholeTable lanes_table(const world::TownT& town);

/// All that was in the trace, by id. Reads it whole, about 15 us a tick. spawned and despawned are
/// absent where the trace does not tell them. Who is hit as a car and becomes a body is one actor,
/// a vehicle with the time at which it was `wrecked`.
WholeTable actors_table(TraceReader& trace);

/// As a CSV file, with units in its heading.
std::string to_csv(const WholeTable& table);

}  // namespace reprise::replay

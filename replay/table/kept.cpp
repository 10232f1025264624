#include "replay/table/kept.h"

#include "replay/level.h"
#include "replay/table/table.h"
#include "world/check.h"

namespace reprise::replay {

Kept kept(Level level, const std::string& table) {
    if (Table::is_of_traffic(table) && level != Level::full)
        return level == Level::keyed ? Kept::part : Kept::nothing;
    if (level != Level::inputs)
        return Kept::all;
    return table == "controls" || table == "ticks" ? Kept::part : Kept::nothing;
}

void require_kept(const TraceReader& trace, const std::string& table) {
    if (kept(trace.level(), table) == Kept::nothing)
        throw world::Error("'" + table +
                           "' is not there: " + lacks_text(trace.path().string(), trace.level()));
}

}  // namespace reprise::replay

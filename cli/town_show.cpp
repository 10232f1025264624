#include "cli/town_show.h"

#include "cli/guard.h"
#include "cli/towns.h"
#include "world/check.h"

namespace reprise::cli {

int town_show(const TownShowOptions& options) {
    load_town(options.town);
    throw world::Error("town show: not yet");
}

}  // namespace reprise::cli

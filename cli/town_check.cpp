#include "cli/town_check.h"

#include "cli/guard.h"
#include "cli/towns.h"
#include "world/check.h"

namespace reprise::cli {

int town_check(const TownCheckOptions& options) {
    load_town(options.town);
    throw world::Error("town check: not yet");
}

}  // namespace reprise::cli

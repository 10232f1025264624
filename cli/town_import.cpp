#include "cli/town_import.h"

#include "world/check.h"

namespace reprise::cli {

int town_import(const TownImportOptions&) {
    throw world::Error("town import: not yet");
}

}  // namespace reprise::cli

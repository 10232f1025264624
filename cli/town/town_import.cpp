#include "cli/town/town_import.h"

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "cli/town/town_folder.h"
#include "towns/maps/map_source.h"
#include "world/check.h"

namespace reprise::cli {

int town_import(const TownImportOptions& options) {
    if (!options.name.empty() && options.name != towns::harmless_name(options.name))
        throw world::Error("--name " + options.name +
                           ": letters, digits, '_', '-' and '.' were expected");
    const towns::TownImport wish{
        options.source, options.name, options.left_hand, options.sidewalks == "guess"};
    say_lines(make_town_folder(wish, options.directory, options.force));
    say("{}: written; `reprise town check {}` tells whether all of it can be driven\n",
        options.directory,
        shell_word(options.directory));
    return exit_good;
}

}  // namespace reprise::cli

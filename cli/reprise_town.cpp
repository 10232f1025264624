// `reprise town`: imports, shows and checks towns. It reads road networks and draws; it has no
// kernel.
#include "cli/process/command_main.h"
#include "cli/town/town_check.h"
#include "cli/town/town_import.h"
#include "cli/town/town_show.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return command_main(argc, argv, [](const CommandLine& line) {
        if (line.town.command == "import")
            return town_import(line.town.import);
        return line.town.command == "show" ? town_show(line.town.show)
                                           : town_check(line.town.check);
    });
}

// `reprise run`, `drive`, `serve`, `verify`, `expand`, `branch`, `import`, `list`, `new` and
// `lint`: the program with SUMO, Bullet and Lua in it.
#include "cli/branch.h"
#include "cli/discover/lint.h"
#include "cli/discover/list.h"
#include "cli/discover/new_scenario.h"
#include "cli/discover/watch.h"
#include "cli/drive.h"
#include "cli/expand.h"
#include "cli/external/serve.h"
#include "cli/process/command_main.h"
#include "cli/run.h"
#include "cli/trace/import.h"
#include "cli/verify.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return command_main(argc, argv, [&](const CommandLine& line) {
        if (line.command == "branch")
            return branch(line.branch);
        if (line.command == "drive")
            return drive(line.drive);
        if (line.command == "expand")
            return expand(line.expand);
        if (line.command == "import")
            return import_log(line.tools.import_from);
        if (line.command == "lint")
            return lint(line.lint);
        if (line.command == "list")
            return list(line.list);
        if (line.command == "new")
            return new_scenario(line.fresh);
        if (line.command == "serve")
            return serve(line.serve);
        if (line.command == "verify")
            return verify(line.verify);
        return line.run.watch ? watch(line.run, argc, argv) : run(line.run);
    });
}

// `reprise run`, `drive`, `serve`, `verify`, `expand`, `branch` and `import`: the program with
// SUMO, Bullet and Lua in it.
#include "cli/branch.h"
#include "cli/drive.h"
#include "cli/expand.h"
#include "cli/external/serve.h"
#include "cli/process/command_main.h"
#include "cli/run.h"
#include "cli/trace/import.h"
#include "cli/verify.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return command_main(argc, argv, [](const CommandLine& line) {
        if (line.command == "branch")
            return branch(line.branch);
        if (line.command == "drive")
            return drive(line.drive);
        if (line.command == "expand")
            return expand(line.expand);
        if (line.command == "import")
            return import_log(line.tools.import_from);
        if (line.command == "serve")
            return serve(line.serve);
        return line.command == "verify" ? verify(line.verify) : run(line.run);
    });
}

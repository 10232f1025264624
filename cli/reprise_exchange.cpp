// `reprise query`, `reprise export` and `reprise show`: the program with SQLite in it.
#include "cli/process/command_main.h"
#include "cli/trace/export.h"
#include "cli/trace/query.h"
#include "cli/trace/show.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return command_main(argc, argv, [](const CommandLine& line) {
        if (line.command == "show")
            return show(line.tools.show);
        return line.command == "query" ? query(line.tools.query)
                                       : export_trace(line.tools.export_to);
    });
}

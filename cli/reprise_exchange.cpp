// `reprise query` and `reprise export`: the program with SQLite in it.
#include "cli/export.h"
#include "cli/guard.h"
#include "cli/options.h"
#include "cli/query.h"

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return guarded(command_text(argc, argv), [&]() -> int {
        CommandLine line;
        if (const auto code = line.parse(argc, argv))
            return *code;
        return line.command == "query" ? query(line.tools.query)
                                       : export_trace(line.tools.export_to);
    });
}

// `reprise query` and `reprise export`: the program with SQLite in it.
#include "cli/options/options.h"
#include "cli/process/guard.h"
#include "cli/trace/export.h"
#include "cli/trace/query.h"

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

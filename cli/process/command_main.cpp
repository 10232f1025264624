#include "cli/process/command_main.h"

#include "cli/process/guard.h"

namespace reprise::cli {

int command_main(int argc, char** argv, const std::function<int(const CommandLine&)>& carry_out) {
    return guarded(command_text(argc, argv), [&] {
        CommandLine line;
        const auto code = line.parse(argc, argv);
        return code ? *code : carry_out(line);
    });
}

}  // namespace reprise::cli

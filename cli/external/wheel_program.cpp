#include "cli/external/wheel_program.h"

#include <fmt/format.h>

#include "cli/process/helper_program.h"
#include "cli/process/reproduce.h"
#include "process/program.h"
#include "world/check.h"

namespace reprise::cli {

std::string wheel_command(const WheelOptions& options) {
    const std::string program = helper_program("reprise-wheel");
    const auto tried =
        process::run_program({.name = program, .words = {"--view", options.view, "--check"}});
    if (tried.code != 0 || tried.signal != 0) {
        constexpr std::string_view prefix = "reprise: ";
        // Libraries of windows grumble before it.
        const auto begin = tried.said.find(prefix);
        if (begin == std::string::npos)
            throw world::Error("no display: " + program + " " + tried.stopped + tried.said);
        const auto from = begin + prefix.size();
        throw world::Error(tried.said.substr(from, tried.said.find('\n', from) - from));
    }
    return fmt::format(
        "exec {} --view {} --pace {}", shell_path(program), options.view, decimal(options.pace));
}

}  // namespace reprise::cli

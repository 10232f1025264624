// The program `reprise`: thin, so that it starts in milliseconds. It reads the command line and
// traces itself, and leaves the heavy work to programs that lie beside it: linking SUMO and OpenCV
// in here would load 222 shared libraries at every start.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <unistd.h>

#include "cli/golden/accept.h"
#include "cli/golden/golden_list.h"
#include "cli/golden/test.h"
#include "cli/process/command_main.h"
#include "cli/process/helper_program.h"
#include "cli/process/picture_memory.h"
#include "cli/trace/cat.h"
#include "cli/trace/diff.h"
#include "cli/trace/info.h"
#include "cli/trace/recover.h"
#include "cli/trace/score.h"
#include "cli/trace/slice.h"
#include "cli/trace/stats.h"
#include "cli/trace/strip.h"
#include "world/check.h"

namespace {

/// Replaces this process by the helper program of that name.
[[noreturn]] void become(const std::string& helper, char** argv) {
    const std::filesystem::path program = reprise::cli::helper_program(helper);
    if (helper == "reprise-render")
        setenv("GLIBC_TUNABLES", reprise::cli::picture_memory, 0);  // who has set it wants it so
    execv(program.c_str(), argv);
    throw reprise::world::Error("cannot start " + program.string() + ": " + std::strerror(errno));
}

}  // namespace

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return command_main(argc, argv, [&](const CommandLine& line) -> int {
        if (line.command == "info")
            return info(line.info);
        if (line.command == "diff" && std::filesystem::is_directory(line.diff.expected) &&
            std::filesystem::is_directory(line.diff.found))
            become("reprise-render", argv);
        if (line.command == "diff")
            return diff(line.diff);
        if (line.command == "recover")
            return recover(line.recover);
        if (line.command == "strip")
            return strip(line.strip);
        if (line.command == "test")
            return test(line.test);
        if (line.command == "accept")
            return accept(line.accept);
        if (line.command == "golden")
            return golden_list(line.golden_list);
        if (line.command == "cat")
            return cat(line.tools.cat);
        if (line.command == "get")
            return get(line.tools.get);
        if (line.command == "slice")
            return slice(line.tools.slice);
        if (line.command == "merge")
            return merge(line.tools.merge);
        if (line.command == "stats")
            return stats(line.tools.stats);
        if (line.command == "score")
            return score(line.tools.score);
        if (line.command == "town")
            become("reprise-town", argv);
        if (line.command == "query" || line.command == "export" || line.command == "show")
            become("reprise-exchange", argv);
        const bool renders = line.command == "render" || line.command == "dataset";
        become(renders ? "reprise-render" : "reprise-run", argv);
    });
}

// The program `reprise`: thin, so that it starts in milliseconds. It reads the command line and
// traces itself, and leaves the heavy work to programs that lie beside it: linking SUMO and OpenCV
// in here would load 222 shared libraries at every start.
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <unistd.h>

#include "cli/diff.h"
#include "cli/guard.h"
#include "cli/info.h"
#include "cli/options.h"
#include "world/check.h"

namespace {

namespace fs = std::filesystem;

/// Replaces this process by the helper program of that name: beside this one, or in
/// ../libexec/reprise where an installation puts it.
[[noreturn]] void become(const std::string& helper, char** argv) {
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    const std::array<fs::path, 2> places{here / helper, here / "../libexec/reprise" / helper};
    for (const fs::path& place : places)
        if (fs::exists(place))
            execv(place.c_str(), argv);
    throw reprise::world::Error("cannot start " + places[0].string() + ": " + std::strerror(errno) +
                                "; is the installation complete?");
}

}  // namespace

int main(int argc, char** argv) {
    using namespace reprise::cli;
    return guarded(command_text(argc, argv), [&]() -> int {
        CommandLine line;
        if (const auto code = line.parse(argc, argv))
            return *code;
        if (line.command == "info")
            return info(line.info);
        if (line.command == "diff")
            return diff(line.diff);
        become(line.command == "render" ? "reprise-render" : "reprise-run", argv);
    });
}

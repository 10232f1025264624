#include "cli/guard.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <unistd.h>

#include "cli/reproduce.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

/// Debian's SUMO and Embree are built with their assertions on and abort when one fails.
extern "C" void on_abort(int) {
    constexpr char text[] =
        "reprise: a library stopped itself (its reason is above); what a run recorded until then "
        "is beside its trace, in .partial\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof(text) - 1);
    _exit(exit_our_fault);
}

}  // namespace

int guarded(const std::string& command_line, const std::function<int()>& work) {
    // A file-size limit shall be an error that we can tell, not a signal that ends us.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGABRT, on_abort);
    try {
        const int code = work();
        if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)
            return code;
        std::fprintf(stderr, "reprise: cannot write to the standard output\n");
        return exit_bad_input;
    } catch (const world::Error& error) {
        std::fprintf(stderr, "reprise: %s\n", error.what());
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "reprise: out of memory\n");
        return exit_bad_input;
    } catch (const std::exception& error) {
        std::fprintf(stderr,
                     "reprise: this is our fault, please report it: %s\n  to come back here: %s\n",
                     error.what(),
                     command_line.c_str());
        return exit_our_fault;
    }
}

std::string command_text(int argc, char** argv) {
    std::string text = "reprise";
    for (int i = 1; i < argc; ++i)
        text += " " + shell_word(argv[i]);
    return text;
}

}  // namespace reprise::cli

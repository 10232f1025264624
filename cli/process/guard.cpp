#include "cli/process/guard.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sys/uio.h>
#include <unistd.h>

#include "cli/process/reproduce.h"
#include "files/ending.h"
#include "files/output_place.h"
#include "process/held_signals.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

/// What a crash says last; written before anything can crash, read in the handler.
std::array<char, 4096> last_words{};
std::atomic<std::size_t> last_words_size = 0;

/// A crash may be a stack that ran over.
alignas(16) std::array<std::byte, 64 << 10> handler_stack;

const char* meaning(int signal) {
    switch (signal) {
        case SIGABRT:
            // Debian's SUMO and Embree are built with their assertions on.
            return "reprise: a library stopped itself (its reason is above)";
        case SIGSEGV:
            return "reprise: crashed: invalid memory access (SIGSEGV)";
        case SIGBUS:
            return "reprise: crashed: memory that is not there (SIGBUS)";
        default:
            return "reprise: crashed: impossible arithmetic (SIGFPE)";
    }
}

/// Only calls that POSIX allows in a signal handler.
void write_last_words(const char* what) {
    const std::array<iovec, 3> parts{{{const_cast<char*>(what), strlen(what)},
                                      {last_words.data(), last_words_size},
                                      {const_cast<char*>("\n"), 1}}};
    [[maybe_unused]] const auto written =
        writev(STDERR_FILENO, parts.data(), static_cast<int>(parts.size()));
}

extern "C" void on_crash(int signal) {
    files::remove_unfinished();
    write_last_words(meaning(signal));
    _exit(exit_our_fault);
}

/// A signal that somebody sent ends us at once; nothing is to be said unless something is left.
void on_ending(int /*signal*/) {
    if (last_words_size != 0)
        write_last_words("reprise: stopped");
}

void catch_crashes() {
    const stack_t stack{handler_stack.data(), 0, handler_stack.size()};

    struct sigaction action {};

    action.sa_handler = on_crash;
    // The next crash, in the handler, ends the process the ordinary way.
    action.sa_flags =
        static_cast<int>(SA_RESETHAND) | (sigaltstack(&stack, nullptr) == 0 ? SA_ONSTACK : 0);
    sigaction(SIGABRT, &action, nullptr);
#ifndef __SANITIZE_ADDRESS__  // whose own report says more
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE})
        sigaction(signal, &action, nullptr);
#endif
}

}  // namespace

int guarded(const std::string& command_line, const std::function<int()>& work) {
    // A file-size limit shall be an error that we can tell, not a signal that ends us.
    std::signal(SIGXFSZ, SIG_IGN);
    catch_crashes();
    files::tidy_up_when_ended(on_ending);
    try {
        const int code = work();
        if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)
            return code;
        std::fprintf(stderr,
                     "reprise: cannot write to the standard output: %s\n",
                     files::write_error(errno).c_str());
        return exit_bad_input;
    } catch (const world::Error& error) {
        std::fprintf(stderr, "reprise: %s\n", world::printable_lines(error.what()).c_str());
        return exit_bad_input;
    } catch (const process::Stopped& stopped) {
        std::fprintf(stderr, "reprise: %s\n", stopped.what());
        return exit_stopped + stopped.signal;
    } catch (const std::filesystem::filesystem_error& error) {
        // Names that are too long, links in circles, folders that may not be entered.
        const std::string where =
            error.path1().empty() ? "this folder" : world::printable_lines(error.path1().string());
        std::fprintf(stderr, "reprise: %s: %s\n", where.c_str(), error.code().message().c_str());
        return exit_bad_input;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "reprise: out of memory\n");
        return exit_bad_input;
    } catch (const std::exception& error) {
        std::fprintf(stderr,
                     "reprise: this is our fault, please report it: %s\n  to come back here: %s\n",
                     world::printable_lines(error.what()).c_str(),
                     world::printable_lines(command_line).c_str());
        return exit_our_fault;
    }
}

void say_when_crashing(const std::string& text) {
    last_words_size = 0;
    last_words_size = text.copy(last_words.data(), last_words.size());
}

std::string command_text(int argc, char** argv) {
    std::string text = "reprise";
    for (int i = 1; i < argc; ++i)
        text += " " + shell_word(argv[i]);
    return text;
}

}  // namespace reprise::cli

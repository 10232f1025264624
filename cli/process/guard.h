#pragma once

#include <functional>
#include <string>

namespace reprise::cli {

enum ExitCode : int {
    exit_good = 0,
    exit_differs = 1,
    exit_bad_input = 2,
    exit_nondeterministic = 3,
    exit_with_loss = 3,
    exit_our_fault = 70,
    exit_stopped = 128  ///< and the number of the signal, as shells have it
};

/// Runs a program's work and turns exceptions into one line on stderr and an exit code: the user's
/// mistakes into 2, ours into 70 with the command that comes back to the same place. Crashes end
/// with 70, too; Ctrl-C while children run with 130.
int guarded(const std::string& command_line, const std::function<int()>& work);

/// From now on, when this process crashes (SIGSEGV, SIGABRT, SIGBUS, SIGFPE), it says so in one
/// line that ends with `text`: where what it did so far is to be found. Shorter than 4000 bytes, or
/// cut.
void say_when_crashing(const std::string& text);

/// The words of a command line as one would type them.
std::string command_text(int argc, char** argv);

}  // namespace reprise::cli

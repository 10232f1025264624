#include "towns/maps/child_program.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "towns/maps/awaited_signals.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

namespace fs = std::filesystem;

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> found;
    for (std::string& word : words)
        found.push_back(word.data());
    found.push_back(nullptr);
    return found;
}

/// From here on, and for what the child does from now on: it has just begun.
void limit(pid_t child, const ProgramLimits& limits) {
    const auto set = [child](auto what, std::uint64_t value, std::uint64_t grace = 0) {
        const rlimit bound{value, value + grace};
        prlimit(child, what, &bound, nullptr);
    };
    set(RLIMIT_AS, limits.memory);
    set(RLIMIT_CPU, limits.seconds, 10);  // at the harder one it would be killed without a reason
    set(RLIMIT_FSIZE, limits.file);
    set(RLIMIT_CORE, 0);
}

std::string text_of(int ended_by, const ProgramLimits& limits) {
    if (ended_by == SIGXCPU)
        return fmt::format("was stopped: it needed more than {} s of processor time",
                           limits.seconds);
    if (ended_by == SIGXFSZ)
        return fmt::format("was stopped: it wrote more than {} MB", limits.file >> 20);
    return fmt::format("crashed (signal {}, {})", ended_by, strsignal(ended_by));
}

std::string beginning_of(const fs::path& path) {
    constexpr std::size_t most = 256 << 10;
    std::string text(most, '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(text.data(), static_cast<std::streamsize>(most));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

/// No input, and both outputs in one file; it works in `scratch`.
posix_spawn_file_actions_t files_of_child(const fs::path& scratch, const std::string& outputs) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, scratch.c_str());
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(
        &actions, STDOUT_FILENO, outputs.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    return actions;
}

pid_t start(const std::string& name,
            std::vector<std::string> words,
            const fs::path& scratch,
            const std::string& outputs,
            const sigset_t& mask) {
    words.insert(words.begin(), name);
    // Nothing that could change what it does.
    std::vector<std::string> variables{"LC_ALL=C", "SUMO_HOME=" + sumo_folder().string()};
    posix_spawn_file_actions_t actions = files_of_child(scratch, outputs);
    // We ignore SIGXFSZ; a child would inherit that.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t usual;
    sigemptyset(&usual);
    sigaddset(&usual, SIGXFSZ);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setsigmask(&attributes, &mask);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    const std::vector<char*> arguments = pointers(words), environment = pointers(variables);
    pid_t child = 0;
    int error = ENOENT;
    for (const std::string& path : {name, "/usr/bin/" + name})  // of PATH first
        if (error == ENOENT)
            error = posix_spawnp(
                &child, path.c_str(), &actions, &attributes, arguments.data(), environment.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error == ENOENT)
        throw world::Error(name +
                           ": there is no such program here; it is in Debian's package sumo");
    if (error != 0)
        throw world::Error(name + ": cannot be started: " + std::strerror(error));
    return child;
}

}  // namespace

fs::path sumo_folder() {
    return "/usr/share/sumo";
}

ProgramResult run_program(const std::string& name,
                          const std::vector<std::string>& words,
                          const fs::path& scratch,
                          const ProgramLimits& limits) {
    const std::string outputs = name + ".said";
    const AwaitedSignals signals;
    const pid_t child = start(name, words, scratch, outputs, signals.before());
    limit(child, limits);
    const int status = signals.wait_for(child, child);
    ProgramResult result;
    result.said = beginning_of(scratch / outputs);
    std::error_code ignored;
    fs::remove(scratch / outputs, ignored);
    if (WIFSIGNALED(status))
        result.stopped = text_of(WTERMSIG(status), limits);
    else
        result.code = WEXITSTATUS(status);
    return result;
}

}  // namespace reprise::towns

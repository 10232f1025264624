#include "cli/discover/watch.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <poll.h>
#include <set>
#include <string>
#include <sys/inotify.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "process/held_signals.h"
#include "scripting/lua/tokens.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

/// Files whose text a scenario names, such as the CSV of a trajectory: those that there are.
std::set<fs::path> files_named(const fs::path& scenario) {
    std::ifstream file(scenario, std::ios::binary);
    const std::string source{std::istreambuf_iterator<char>(file), {}};
    std::set<fs::path> found;
    scripting::Tokens tokens(source);
    for (scripting::Token token = tokens.next(); token.kind != scripting::Token::Kind::end;
         token = tokens.next()) {
        std::error_code ignored;
        const fs::path named = scenario.parent_path() / fs::path(token.spelling);
        if (token.kind == scripting::Token::Kind::text && !token.spelling.empty() &&
            fs::is_regular_file(named, ignored))
            found.insert(named.lexically_normal());
    }
    return found;
}

/// Hears when one of some files is saved: written in place, or replaced by another of its name, as
/// most editors do. Folders are what is watched, since a replaced file is another file.
class Saves {
  public:
    Saves() : descriptor_(inotify_init1(IN_CLOEXEC | IN_NONBLOCK)) {
        if (descriptor_ < 0)
            throw world::Error(std::string("--watch: ") + std::strerror(errno));
    }

    ~Saves() { close(descriptor_); }

    Saves(const Saves&) = delete;
    Saves& operator=(const Saves&) = delete;

    int descriptor() const { return descriptor_; }

    void watch(const std::set<fs::path>& files) {
        files_ = files;
        for (const fs::path& file : files) {
            const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
            const int number =
                inotify_add_watch(descriptor_, folder.c_str(), IN_CLOSE_WRITE | IN_MOVED_TO);
            if (number < 0)
                throw world::Error("--watch: " + folder.string() + ": " + std::strerror(errno));
            folders_[number] = folder;
        }
    }

    /// Takes what has happened since; the file that was saved, or "".
    std::string take() {
        std::string saved;
        alignas(inotify_event) std::array<char, 4096> bytes{};
        for (ssize_t size = 0; (size = read(descriptor_, bytes.data(), bytes.size())) > 0;) {
            for (ssize_t at = 0; at < size;) {
                inotify_event event{};
                std::memcpy(&event, bytes.data() + at, sizeof event);
                const char* name = bytes.data() + at + sizeof event;
                at += static_cast<ssize_t>(sizeof event + event.len);
                const auto folder = folders_.find(event.wd);
                if (event.len == 0 || folder == folders_.end())
                    continue;
                const fs::path file = (folder->second / name).lexically_normal();
                if (files_.count(file) != 0)
                    saved = file.string();
            }
        }
        return saved;
    }

  private:
    int descriptor_;
    std::map<int, fs::path> folders_;
    std::set<fs::path> files_;
};

/// This program with the same words but --watch. It leads a group of its own: Ctrl-C comes to us.
pid_t start(const process::HeldSignals& signals, int argc, char** argv) {
    std::vector<char*> words;
    for (int i = 0; i < argc; ++i)
        if (std::strcmp(argv[i], "--watch") != 0)
            words.push_back(argv[i]);
    words.push_back(nullptr);
    const pid_t us = getpid();
    const pid_t child = fork();
    if (child < 0)
        throw world::Error(std::string("--watch: no process can be started: ") +
                           std::strerror(errno));
    if (child == 0) {
        setpgid(0, 0);
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() != us)
            _exit(exit_our_fault);
        signals.release();
        execv("/proc/self/exe", words.data());
        _exit(exit_our_fault);
    }
    return child;
}

bool has_ended(pid_t child) {
    return waitpid(child, nullptr, WNOHANG) == child;
}

void end(pid_t child) {
    kill(child, SIGTERM);
    while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
}

void tell(const std::string& text) {
    say("{}\n", text);
    std::fflush(stdout);
}

std::string names(const std::set<fs::path>& files) {
    std::string text;
    for (const fs::path& file : files)
        text += (text.empty() ? "" : ", ") + file.string();
    return text;
}

}  // namespace

int watch(const RunOptions& options, int argc, char** argv) {
    const fs::path scenario = fs::path(options.scenario).lexically_normal();
    if (scenario.extension() == ".mcap" || !fs::is_regular_file(scenario))
        throw world::Error("--watch: '" + options.scenario +
                           (fs::exists(scenario) ? "' is no scenario" : "' is not there"));
    const process::HeldSignals signals;
    Saves saves;
    pid_t child = 0;  // 0: none runs
    std::string saved = scenario.string();
    for (;;) {
        if (!saved.empty()) {
            if (child != 0)
                end(child);
            std::set<fs::path> files = files_named(scenario);
            files.insert(scenario);
            saves.watch(files);
            child = start(signals, argc, argv);
        }
        std::array<pollfd, 2> awaited{
            {{signals.descriptor(), POLLIN, 0}, {saves.descriptor(), POLLIN, 0}}};
        while (poll(awaited.data(), awaited.size(), -1) < 0 && errno == EINTR) {
        }
        for (int signal = signals.take(); signal != 0; signal = signals.take()) {
            if (signal == SIGCHLD)
                continue;
            if (child != 0)
                end(child);
            return exit_stopped + signal;
        }
        if (child != 0 && has_ended(child)) {
            child = 0;
            std::set<fs::path> files = files_named(scenario);
            files.insert(scenario);
            tell("watching " + names(files) + "; Ctrl-C ends it");
        }
        saved = saves.take();
        if (!saved.empty())
            tell(saved + " was saved");
    }
}

}  // namespace reprise::cli

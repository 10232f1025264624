#include "process/program.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <optional>
#include <string_view>
#include <unistd.h>

#include "process/nameless_file.h"
#include "world/check.h"

namespace reprise::process {

namespace {

namespace fs = std::filesystem;
constexpr int cannot_start = 127;  ///< as shells have it

bool is_program(const fs::path& path) {
    std::error_code unreadable;
    return fs::is_regular_file(path, unreadable) && access(path.c_str(), X_OK) == 0;
}

[[noreturn]] void throw_missing(const Program& program) {
    throw world::Error(
        program.name + ": there is no such program here" +
        (program.package.empty() ? "" : "; it is in Debian's package " + program.package));
}

std::string find(const Program& program) {
    if (program.name.find('/') != std::string::npos)
        return program.name;
    if (auto path = path_of_program(program.name))
        return *path;
    throw_missing(program);
}

std::vector<std::string> environment_of(const Program& program) {
    std::vector<std::string> all = program.variables;
    const auto is_given = [&](std::string_view ours) {
        const std::string_view name = ours.substr(0, ours.find('=') + 1);
        for (const std::string& given : program.variables)
            if (given.starts_with(name))
                return true;
        return false;
    };
    if (!program.only_these_variables)
        for (char** ours = environ; *ours != nullptr; ++ours)
            if (!is_given(*ours))
                all.emplace_back(*ours);
    return all;
}

/// All that the child needs, made before it begins: there it may ask for no memory.
class Start {
  public:
    explicit Start(const Program& program)
        : program_(program),
          path_(find(program)),
          words_(program.words),
          variables_(environment_of(program)),
          log_(program.log.empty() ? fs::path() : fs::absolute(program.log)) {
        words_.insert(words_.begin(), program.name);
        if (log_.empty())
            outputs_.emplace();
        arguments_ = pointers(words_);
        environment_ = pointers(variables_);
    }

    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;

    /// In the child, which comes back with an exit code only when it cannot.
    int go() const {
        const int in = open("/dev/null", O_RDONLY | O_CLOEXEC);
        const int out = outputs_
                            ? outputs_->descriptor()
                            : open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (in < 0 || out < 0)
            return fail(Step::open);
        dup2(in, STDIN_FILENO);
        dup2(out, STDOUT_FILENO);
        dup2(out, STDERR_FILENO);
        if (!program_.folder.empty() && chdir(program_.folder.c_str()) != 0)
            return fail(Step::change_folder);
        std::signal(SIGXFSZ, SIG_DFL);  // which we ignore, and it would inherit that
        impose(program_.limits);
        execve(path_.c_str(), arguments_.data(), environment_.data());
        return fail(Step::execute);
    }

    /// Throws world::Error when the child did not get as far as to be the program.
    ProgramResult result(const Ended& ended) const {
        throw_failure();
        ProgramResult result{ended, "", ""};
        if (ended.signal != 0)
            result.stopped = reason(ended.signal, program_.limits);
        if (outputs_)
            result.said = outputs_->read(program_.most_said);
        return result;
    }

  private:
    enum class Step : int { open, change_folder, execute };

    struct Failure {
        Step step{};
        int error = 0;
    };

    static std::vector<char*> pointers(std::vector<std::string>& words) {
        std::vector<char*> found;
        for (std::string& word : words)
            found.push_back(word.data());
        found.push_back(nullptr);
        return found;
    }

    int fail(Step step) const {
        const Failure failure{step, errno};
        [[maybe_unused]] const auto written =
            ::write(failure_.descriptor(), &failure, sizeof(failure));
        return cannot_start;
    }

    void throw_failure() const {
        const std::string told = failure_.read(sizeof(Failure));
        if (told.size() < sizeof(Failure))
            return;
        Failure failure;
        std::memcpy(&failure, told.data(), sizeof(failure));
        if (failure.step == Step::execute && failure.error == ENOENT)
            throw_missing(program_);
        const std::string what = failure.step == Step::open            ? log_.string()
                                 : failure.step == Step::change_folder ? program_.folder.string()
                                                                       : program_.name;
        throw world::Error(what +
                           (failure.step == Step::execute
                                ? ": cannot be started: "
                                : ": cannot be opened for " + program_.name + ": ") +
                           std::strerror(failure.error));
    }

    const Program& program_;
    std::string path_;
    std::vector<std::string> words_;
    std::vector<std::string> variables_;
    fs::path log_;
    std::vector<char*> arguments_;
    std::vector<char*> environment_;
    std::optional<NamelessFile> outputs_;
    NamelessFile failure_;
};

}  // namespace

std::optional<std::string> path_of_program(const std::string& name) {
    if (name.find('/') != std::string::npos)
        return is_program(name) ? std::optional(name) : std::nullopt;
    const char* variable = std::getenv("PATH");
    std::string places = variable == nullptr ? "" : variable;
    places += ":/usr/bin";
    for (std::size_t from = 0; from < places.size();) {
        const std::size_t to = std::min(places.find(':', from), places.size());
        if (to > from) {
            const fs::path path = fs::absolute(places.substr(from, to - from)) / name;
            if (is_program(path))
                return path;
        }
        from = to + 1;
    }
    return std::nullopt;
}

std::vector<ProgramResult> run_programs(const Children& children,
                                        const std::vector<Program>& programs,
                                        const std::function<void(std::size_t)>& waiting) {
    std::vector<ProgramResult> results(programs.size());
    std::vector<std::optional<Start>> starts(programs.size());  // files are open while it runs
    const Tasks tasks{programs.size(),
                      [&](std::size_t i) { starts[i].emplace(programs[i]); },
                      [&](std::size_t i) { return starts[i]->go(); },
                      [&](std::size_t i, const Ended& ended) {
                          results[i] = starts[i]->result(ended);
                          starts[i].reset();
                      }};
    children.run(tasks, waiting);
    return results;
}

ProgramResult run_program(const Program& program) {
    return run_programs(Children(1), {program}).front();
}

}  // namespace reprise::process

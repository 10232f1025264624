#include "cli/process/worker.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "towns/maps/awaited_signals.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

constexpr rlim_t most_memory = rlim_t{8} << 30;  ///< [bytes] of address space
constexpr rlim_t most_seconds = 600;             ///< of processor time

/// Where the copy writes what became of its work: memory, which needs no reader meanwhile.
class Note {
  public:
    Note() : file_(memfd_create("reprise_worker", MFD_CLOEXEC)) {
        REPRISE_CHECK(file_ >= 0, std::strerror(errno));
    }

    ~Note() { close(file_); }

    Note(const Note&) = delete;
    Note& operator=(const Note&) = delete;

    void write(const std::string& text) const {
        for (std::size_t from = 0; from < text.size();) {
            const ssize_t wrote = ::write(file_, text.data() + from, text.size() - from);
            if (wrote <= 0)
                return;
            from += static_cast<std::size_t>(wrote);
        }
    }

    std::string read() const {
        const off_t size = lseek(file_, 0, SEEK_END);
        std::string text(static_cast<std::size_t>(size), '\0');
        if (pread(file_, text.data(), text.size(), 0) != size)
            text.clear();
        return text;
    }

  private:
    int file_;
};

void limit_myself() {
#ifndef __SANITIZE_ADDRESS__  // which maps terabytes
    const rlimit memory{most_memory, most_memory};
    setrlimit(RLIMIT_AS, &memory);
#endif
    const rlimit seconds{most_seconds, most_seconds + 10};
    setrlimit(RLIMIT_CPU, &seconds);
}

[[noreturn]] void be_worker(pid_t parent,
                            const sigset_t& mask,
                            const Note& note,
                            const std::string& name,
                            const std::function<std::string()>& work) {
    setpgid(0, 0);  // so that its own children can be ended with it
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent)
        _exit(exit_our_fault);  // it went before we could ask to go with it
    sigprocmask(SIG_SETMASK, &mask, nullptr);
    limit_myself();
    int code = exit_our_fault;
    try {
        note.write(work());
        code = exit_good;
    } catch (const world::Error& error) {
        note.write(error.what());
        code = exit_bad_input;
    } catch (const std::bad_alloc&) {
        note.write(
            fmt::format("{}: more than {} GB of memory would be needed", name, most_memory >> 30));
        code = exit_bad_input;
    } catch (const std::exception& error) {
        note.write(error.what());
    }
    std::fflush(nullptr);
    _exit(code);
}

}  // namespace

std::string in_worker(const std::string& name, const std::function<std::string()>& work) {
    std::fflush(nullptr);
    const Note note;
    const towns::AwaitedSignals signals;
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child == 0)
        be_worker(parent, signals.before(), note, name, work);
    if (child < 0)
        throw world::Error(fmt::format("cannot start a process: {}", std::strerror(errno)));
    setpgid(child, child);  // whoever comes first
    const int status = signals.wait_for(child, -child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == exit_good)
        return note.read();
    if (WIFEXITED(status) && WEXITSTATUS(status) == exit_bad_input)
        throw world::Error(note.read());
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
        throw world::Error(
            fmt::format("{}: stopped: it needed more than {} s", name, most_seconds));
    const std::string said = note.read();
    throw std::runtime_error(said.empty() ? name + ": the import crashed" : said);
}

}  // namespace reprise::cli

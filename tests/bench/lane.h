#pragma once

#include <array>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "world/digest.h"

namespace reprise::bench {

/// What so many ticks of a lane took.
struct Lap {
    double wall = 0;   ///< [s] of a tick, median
    double cpu = 0;    ///< [s] of a tick, mean, of the process that simulates
    double bytes = 0;  ///< of the last tick and its traffic
    world::Digest128 chain;
    double alone = 0;      ///< [s] of a tick of the same run without what is measured, median
    double alone_cpu = 0;  ///< [s] of such a tick, mean
};

/// A copy of this process that simulates when it is asked to: there is one kernel a process, and
/// several ways to drive are to be measured in turn, in the same minute.
class Lane {
  public:
    using Runner = std::function<Lap(unsigned ticks)>;

    /// `make` is called in the copy.
    explicit Lane(const std::function<Runner()>& make) {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            throw std::runtime_error("no socket");
        child_ = fork();
        if (child_ == 0) {
            close(ends[0]);
            serve(ends[1], make);
        }
        close(ends[1]);
        socket_ = ends[0];
    }

    Lane(Lane&& other) noexcept
        : socket_(std::exchange(other.socket_, -1)),
          child_(std::exchange(other.child_, -1)) {}

    ~Lane() {
        if (child_ < 0)
            return;
        const unsigned no_more = 0;  // later lanes have copies of our end: it would stay open
        send(socket_, &no_more, sizeof(no_more), MSG_NOSIGNAL);
        waitpid(child_, nullptr, 0);
        close(socket_);
    }

    Lane(const Lane&) = delete;
    Lane& operator=(const Lane&) = delete;
    Lane& operator=(Lane&&) = delete;

    /// So many ticks more.
    Lap run(unsigned ticks) const {
        Lap lap;
        if (send(socket_, &ticks, sizeof(ticks), MSG_NOSIGNAL) != sizeof(ticks) ||
            recv(socket_, &lap, sizeof(lap), MSG_WAITALL) != sizeof(lap))
            throw std::runtime_error("a lane is gone");
        return lap;
    }

  private:
    [[noreturn]] static void serve(int socket, const std::function<Runner()>& make) {
        try {
            const Runner run = make();
            unsigned ticks = 0;
            while (read(socket, &ticks, sizeof(ticks)) == sizeof(ticks) && ticks > 0) {
                const Lap lap = run(ticks);
                if (write(socket, &lap, sizeof(lap)) != sizeof(lap))
                    break;
            }
        } catch (const std::exception& error) {
            std::fprintf(stderr, "a lane: %s\n", error.what());
            _exit(1);
        }
        _exit(0);
    }

    int socket_ = -1;
    pid_t child_ = -1;
};

}  // namespace reprise::bench

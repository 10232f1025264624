#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace reprise::bench {

/// A child at a socket that reads so many bytes, which eight of them say before, and replies with
/// few: what a round trip takes where nobody makes or reads a message.
class BareChild {
  public:
    BareChild() {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            throw std::runtime_error("no socket");
        child_ = fork();
        if (child_ == 0) {
            close(ends[0]);
            serve(ends[1]);
        }
        close(ends[1]);
        socket_ = ends[0];
    }

    ~BareChild() {
        close(socket_);
        waitpid(child_, nullptr, 0);
    }

    BareChild(const BareChild&) = delete;
    BareChild& operator=(const BareChild&) = delete;

    /// [bytes] in one message, and the answer to it.
    void round_trip(std::size_t size) {
        message_.resize(size + sizeof(std::uint64_t));
        const std::uint64_t count = size;
        std::memcpy(message_.data(), &count, sizeof(count));
        std::array<char, answer_bytes> answer{};
        if (!move(socket_, message_.data(), message_.size(), true) ||
            !move(socket_, answer.data(), answer.size(), false))
            throw std::runtime_error("the bare child is gone");
    }

  private:
    static constexpr std::size_t answer_bytes = 64;

    static bool move(int socket, char* bytes, std::size_t size, bool out) {
        for (std::size_t done = 0; done < size;) {
            const ssize_t count = out ? write(socket, bytes + done, size - done)
                                      : read(socket, bytes + done, size - done);
            if (count <= 0)
                return false;
            done += static_cast<std::size_t>(count);
        }
        return true;
    }

    [[noreturn]] static void serve(int socket) {
        std::vector<char> message;
        std::array<char, answer_bytes> answer{};
        for (std::uint64_t size = 0;
             move(socket, reinterpret_cast<char*>(&size), sizeof(size), false);) {
            message.resize(size);
            if (!move(socket, message.data(), size, false) ||
                !move(socket, answer.data(), answer.size(), true))
                break;
        }
        _exit(0);
    }

    int socket_ = -1;
    pid_t child_ = -1;
    std::vector<char> message_;
};

}  // namespace reprise::bench

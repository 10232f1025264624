#include "remote/frame_channel.h"

#include <array>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace reprise::remote {

namespace {

static_assert(std::endian::native == std::endian::little, "frames are sent as they lie in memory");

constexpr double glance = 0.1;  // [s]

struct Header {
    std::uint32_t size = 0;
    std::uint32_t kind = 0;
};

/// [s] of a clock that only runs forward.
double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

template <class Table>
bool holds(std::span<const std::uint8_t> body) {
    flatbuffers::Verifier verifier(body.data(), body.size());
    return verifier.VerifyBuffer<Table>(nullptr);
}

bool is_message(Kind kind, std::span<const std::uint8_t> body) {
    switch (kind) {
        case Kind::hello:
            return holds<Hello>(body);
        case Kind::ready:
            return holds<Ready>(body);
        case Kind::observation:
            return holds<Observation>(body);
        case Kind::control:
            return holds<Control>(body);
        case Kind::goodbye:
            return holds<Goodbye>(body);
    }
    return false;
}

}  // namespace

/// Until a moment, and not for ever where somebody may give up.
struct FrameChannel::Wait {
    explicit Wait(const Patience& patience)
        : given_up(&patience.given_up),
          until(patience.seconds ? std::optional(now() + *patience.seconds) : std::nullopt) {}

    /// Until the socket is ready for `events`, or throws.
    void until_ready(int descriptor, short events) const {
        for (;;) {
            double longest = *given_up ? glance : 3600;  // [s]
            if (until) {
                longest = std::min(longest, *until - now());
                if (longest <= 0)
                    throw ChannelFault("said nothing in time");
            }
            pollfd one{descriptor, events, 0};
            const int ready = poll(&one, 1, static_cast<int>(std::ceil(longest * 1e3)));
            if (ready > 0)
                return;
            if (ready < 0 && errno != EINTR)
                throw ChannelFault(std::string("cannot be waited for: ") + std::strerror(errno));
            if (*given_up && (*given_up)())
                throw ChannelFault("was waited for no longer");
        }
    }

    const std::function<bool()>* given_up;
    std::optional<double> until;  ///< by now()
};

void wait_for_input(int descriptor, const Patience& patience) {
    FrameChannel::Wait(patience).until_ready(descriptor, POLLIN);
}

FrameChannel::FrameChannel(int descriptor, std::size_t largest)
    : descriptor_(descriptor),
      largest_(largest) {}

FrameChannel::FrameChannel(FrameChannel&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      largest_(other.largest_) {}

FrameChannel::~FrameChannel() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

void FrameChannel::send(Kind kind, std::span<const std::uint8_t> body, const Patience& patience) {
    Header header{static_cast<std::uint32_t>(body.size()), static_cast<std::uint32_t>(kind)};
    std::array<iovec, 2> parts{iovec{&header, sizeof(header)},
                               iovec{const_cast<std::uint8_t*>(body.data()), body.size()}};
    const Wait wait(patience);
    std::size_t left = sizeof(header) + body.size();
    while (left > 0) {
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = parts.size();
        const ssize_t sent = sendmsg(descriptor_, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0) {
            if (errno == EAGAIN)
                wait.until_ready(descriptor_, POLLOUT);
            else if (errno != EINTR)
                throw ChannelFault(errno == EPIPE || errno == ECONNRESET ? "has hung up"
                                                                         : std::strerror(errno));
            continue;
        }
        left -= static_cast<std::size_t>(sent);
        auto taken = static_cast<std::size_t>(sent);
        for (iovec& part : parts) {
            const std::size_t of_this = std::min(taken, part.iov_len);
            part.iov_base = static_cast<char*>(part.iov_base) + of_this;
            part.iov_len -= of_this;
            taken -= of_this;
        }
    }
}

void FrameChannel::read(void* target, std::size_t size, const Wait& wait) {
    auto* at = static_cast<char*>(target);
    while (size > 0) {
        const ssize_t came = recv(descriptor_, at, size, MSG_DONTWAIT);
        if (came == 0)
            throw ChannelFault("has hung up");
        if (came < 0) {
            if (errno == EAGAIN)
                wait.until_ready(descriptor_, POLLIN);
            else if (errno != EINTR)
                throw ChannelFault(errno == ECONNRESET ? "has hung up" : std::strerror(errno));
            continue;
        }
        at += came;
        size -= static_cast<std::size_t>(came);
    }
}

Frame FrameChannel::receive(const Patience& patience) {
    const Wait wait(patience);
    Header header;
    read(&header, sizeof(header), wait);
    if (header.size > largest_)
        throw ChannelFault(
            fmt::format("said a message of {} bytes, where {} is the most", header.size, largest_));
    Frame frame{static_cast<Kind>(header.kind),
                std::vector<std::uint64_t>((header.size + 7) / 8),
                header.size};
    read(frame.words.data(), header.size, wait);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(frame.words.data());
    if (!is_message(frame.kind, {bytes, frame.size}))
        throw ChannelFault(
            fmt::format("said what is no message (kind {}, {} bytes): docs/drivers.md",
                        header.kind,
                        header.size));
    return frame;
}

}  // namespace reprise::remote

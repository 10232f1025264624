#include "remote/frame_channel.h"

#include <algorithm>
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
constexpr std::size_t longest_ahead =
    1 << 20;  // [bytes] of a body; an observation without pictures is shorter

struct Header {
    std::uint32_t size = 0;
    std::uint32_t kind = 0;
};

/// Room beside a message for one descriptor.
struct DescriptorRoom {
    void offer(msghdr& message) {
        message.msg_control = bytes.data();
        message.msg_controllen = bytes.size();
    }

    void put(msghdr& message, int descriptor) {
        offer(message);
        cmsghdr* head = CMSG_FIRSTHDR(&message);
        head->cmsg_level = SOL_SOCKET;
        head->cmsg_type = SCM_RIGHTS;
        head->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(head), &descriptor, sizeof(int));
    }

    /// What came; below 0: nothing.
    static int taken(msghdr& message) {
        const cmsghdr* head = CMSG_FIRSTHDR(&message);
        if (head == nullptr || head->cmsg_level != SOL_SOCKET || head->cmsg_type != SCM_RIGHTS ||
            head->cmsg_len < CMSG_LEN(sizeof(int)))
            return -1;
        int descriptor = -1;
        std::memcpy(&descriptor, CMSG_DATA(head), sizeof(int));
        return descriptor;
    }

    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> bytes{};
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
        case Kind::open:
            return holds<Open>(body);
        case Kind::reset:
            return holds<Reset>(body);
        case Kind::fault:
            return holds<Fault>(body);
        case Kind::channel:
            return holds<Channel>(body);
    }
    return false;
}

/// Throws ChannelFault.
void check(const Frame& frame) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(frame.words.data());
    if (!is_message(frame.kind, {bytes, frame.size}))
        throw ChannelFault(
            fmt::format("said what is no message (kind {}, {} bytes): docs/drivers.md",
                        static_cast<std::uint32_t>(frame.kind),
                        frame.size));
}

/// Once it goes: awake again, however the sleep ended.
class Awake {
  public:
    explicit Awake(Mailbox& mailbox) : mailbox_(&mailbox) {}

    ~Awake() { mailbox_->sleep(false); }

    Awake(const Awake&) = delete;
    Awake& operator=(const Awake&) = delete;

  private:
    Mailbox* mailbox_;
};

}  // namespace

/// Until a moment, and not for ever where somebody may give up.
struct FrameChannel::Wait {
    explicit Wait(const Patience& patience)
        : given_up(&patience.given_up),
          until(patience.seconds ? std::optional(now() + *patience.seconds) : std::nullopt) {}

    bool is_endless() const { return !*given_up && !until; }

    void until_ready(int descriptor, short events) const {
        pollfd one{descriptor, events, 0};
        until_any_ready({&one, 1});
    }

    /// Until one of the sockets is ready for its events, or throws.
    void until_any_ready(std::span<pollfd> sockets) const {
        for (;;) {
            double longest = *given_up ? glance : 3600;  // [s]
            if (until) {
                longest = std::min(longest, *until - now());
                if (longest <= 0)
                    throw ChannelFault("said nothing in time");
            }
            const int ready =
                poll(sockets.data(), sockets.size(), static_cast<int>(std::ceil(longest * 1e3)));
            if (ready > 0)
                return;
            if (ready < 0 && errno != EINTR)
                throw ChannelFault(std::string("cannot be waited for: ") + std::strerror(errno));
            if (*given_up && (*given_up)())
                throw ChannelFault("was waited for no longer", ChannelFault::Why::given_up);
        }
    }

    const std::function<bool()>* given_up;
    std::optional<double> until;  ///< by now()
};

void wait_for_input(int descriptor, const Patience& patience) {
    wait_for_any_input({&descriptor, 1}, patience);
}

void wait_for_any_input(std::span<const int> descriptors, const Patience& patience) {
    std::vector<pollfd> sockets;
    for (const int descriptor : descriptors)
        sockets.push_back({descriptor, POLLIN, 0});
    FrameChannel::Wait(patience).until_any_ready(sockets);
}

FrameChannel::FrameChannel(int descriptor, std::size_t largest)
    : descriptor_(descriptor),
      largest_(largest) {}

FrameChannel::FrameChannel(FrameChannel&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      largest_(other.largest_),
      mailbox_(std::move(other.mailbox_)),
      polling_(other.polling_),
      reads_whole_messages_(other.reads_whole_messages_),
      last_size_(other.last_size_),
      room_(std::move(other.room_)),
      ahead_begin_(other.ahead_begin_),
      ahead_end_(other.ahead_end_) {}

FrameChannel::~FrameChannel() {
    if (descriptor_ >= 0)
        close(descriptor_);
}

bool FrameChannel::carries_descriptors() const {
    sockaddr_storage address{};
    socklen_t size = sizeof(address);
    return getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size) == 0 &&
           address.ss_family == AF_UNIX;
}

void FrameChannel::send(Kind kind,
                        std::span<const std::uint8_t> body,
                        const Patience& patience,
                        int handed_over) {
    if (mailbox_ && handed_over < 0 && mailbox_->put(kind, body))
        return;
    send_through_socket(kind, body, patience, handed_over);
    if (mailbox_)
        mailbox_->sent();
}

void FrameChannel::send_through_socket(Kind kind,
                                       std::span<const std::uint8_t> body,
                                       const Patience& patience,
                                       int handed_over) {
    Header header{static_cast<std::uint32_t>(body.size()), static_cast<std::uint32_t>(kind)};
    std::array<iovec, 2> parts{iovec{&header, sizeof(header)},
                               iovec{const_cast<std::uint8_t*>(body.data()), body.size()}};
    const Wait wait(patience);
    std::size_t left = sizeof(header) + body.size();
    while (left > 0) {
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = parts.size();
        DescriptorRoom room;
        if (handed_over >= 0)
            room.put(message, handed_over);
        const ssize_t sent = sendmsg(descriptor_, &message, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0) {
            if (errno == EAGAIN)
                wait.until_ready(descriptor_, POLLOUT);
            else if (errno != EINTR)
                throw errno == EPIPE || errno == ECONNRESET ? ChannelFault::hung_up()
                                                            : ChannelFault(std::strerror(errno));
            continue;
        }
        handed_over = -1;  // it went with the first byte
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

bool FrameChannel::has_input() const {
    return (mailbox_ && mailbox_->has_letter()) || socket_has_input();
}

bool FrameChannel::socket_has_input() const {
    pollfd one{descriptor_, POLLIN, 0};
    return ahead_begin_ < ahead_end_ || poll(&one, 1, 0) > 0;
}

/// Never sleeps in recvmsg(): there it would be woken for nothing when the other end reads what we
/// said, at the cost of that one, some 15 us. poll() is told what it is to be woken for.
void FrameChannel::await_input(const Wait& wait) {
    if (!polling_.finds([&] { return socket_has_input(); }))
        wait.until_ready(descriptor_, POLLIN);
}

std::size_t FrameChannel::read_some(void* target,
                                    std::size_t most,
                                    const Wait& wait,
                                    Descriptor& came_along) {
    // A driver has to wait for each tick, a run has done its own part and mostly finds the answer.
    if (wait.is_endless())
        await_input(wait);
    for (;;) {
        iovec part{target, most};
        msghdr message{};
        message.msg_iov = &part;
        message.msg_iovlen = 1;
        DescriptorRoom room;
        room.offer(message);
        const ssize_t came = recvmsg(descriptor_, &message, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
        if (came == 0)
            throw ChannelFault::hung_up();
        if (came < 0) {
            if (errno == EAGAIN)
                await_input(wait);
            else if (errno != EINTR)
                throw errno == ECONNRESET ? ChannelFault::hung_up()
                                          : ChannelFault(std::strerror(errno));
            continue;
        }
        if (const int number = DescriptorRoom::taken(message); number >= 0)
            came_along = Descriptor(number);
        return static_cast<std::size_t>(came);
    }
}

void FrameChannel::read(void* target, std::size_t size, const Wait& wait, Descriptor& came_along) {
    auto* at = static_cast<std::uint8_t*>(target);
    const std::size_t kept = std::min(size, ahead_end_ - ahead_begin_);
    at = std::copy_n(room_.begin() + static_cast<std::ptrdiff_t>(ahead_begin_), kept, at);
    ahead_begin_ += kept;
    for (std::size_t left = size - kept; left > 0;) {
        const std::size_t came = read_some(at, left, wait, came_along);
        at += came;
        left -= came;
    }
}

Frame FrameChannel::receive(const Patience& patience) {
    const Wait wait(patience);
    if (!mailbox_)
        return receive_from_socket(wait);
    if (auto letter = receive_letter(wait))
        return std::move(*letter);
    Frame frame = receive_from_socket(wait);
    mailbox_->received();
    return frame;
}

std::optional<Frame> FrameChannel::receive_letter(const Wait& wait) {
    if (!mailbox_->has_letter())
        await_letter(wait);
    auto letter = mailbox_->take();
    if (!letter)
        return std::nullopt;
    Frame frame{letter->kind, std::move(letter->words), letter->size};
    check(frame);
    return frame;
}

/// Or for something to read. Of the two ways letters come by one, the socket is asked seldom.
void FrameChannel::await_letter(const Wait& wait) {
    constexpr unsigned seldom = 16;
    unsigned looks = 0;
    if (polling_.finds([&] {
            return mailbox_->has_letter() || (++looks % seldom == 0 && socket_has_input());
        }))
        return;
    mailbox_->sleep(true);
    const Awake later(*mailbox_);
    if (!mailbox_->has_letter() && ahead_begin_ == ahead_end_)
        wait.until_ready(descriptor_, POLLIN);
}

Frame FrameChannel::receive_from_socket(const Wait& wait) {
    Header header;
    Descriptor came_along;
    if (reads_whole_messages_ && ahead_begin_ == ahead_end_) {
        // Observations grow by a car or an event from tick to tick, controls by a few bytes.
        constexpr std::size_t growth = 64;
        const std::size_t most = sizeof(header) + last_size_ + last_size_ / 8 + growth;
        room_.resize(std::max(room_.size(), most));
        const std::size_t came = read_some(room_.data(), most, wait, came_along);
        ahead_begin_ = 0;
        ahead_end_ = came;
    }
    read(&header, sizeof(header), wait, came_along);
    last_size_ = std::min<std::size_t>(header.size, longest_ahead);
    if (header.size > largest_)
        throw ChannelFault(
            fmt::format("said a message of {} bytes, where {} is the most", header.size, largest_));
    Frame frame{static_cast<Kind>(header.kind),
                std::vector<std::uint64_t>((header.size + 7) / 8),
                header.size};
    read(frame.words.data(), header.size, wait, came_along);
    frame.descriptor = std::move(came_along);
    check(frame);
    return frame;
}

}  // namespace reprise::remote

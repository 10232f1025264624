#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "remote/descriptor.h"
#include "remote/mailbox.h"
#include "remote/polling.h"
#include "remote/wire_generated.h"

namespace reprise::remote {

/// How long to wait for the other end.
struct Patience {
    std::optional<double> seconds{};      ///< of real time; without one for ever
    std::function<bool()> given_up = {};  ///< asked about ten times a second: wait no longer
};

/// The other end is gone, silent for too long, or says what is no message of ours.
class ChannelFault : public std::runtime_error {
  public:
    enum class Why : std::uint8_t { other, hung_up, given_up };

    explicit ChannelFault(const std::string& what, Why its_why = Why::other)
        : std::runtime_error(what),
          why(its_why) {}

    static ChannelFault hung_up() { return ChannelFault("has hung up", Why::hung_up); }

    Why why;
};

/// A message as it came. Its body has been verified to be a table of its kind.
struct Frame {
    Kind kind = Kind::goodbye;
    std::vector<std::uint64_t> words;  ///< the body, aligned as its doubles want it
    std::size_t size = 0;              ///< [bytes] of the body
    Descriptor descriptor{};           ///< that came with it

    template <class Table>
    const Table& as() const {
        return *flatbuffers::GetRoot<Table>(words.data());
    }
};

/// Waits until there is something to read, or somebody to accept. Throws ChannelFault.
void wait_for_input(int descriptor, const Patience& patience);

/// The same for any of several; below 0 stands for none.
void wait_for_any_input(std::span<const int> descriptors, const Patience& patience);

/// One connected stream socket that carries frames (wire.fbs). Owns the descriptor.
class FrameChannel {
  public:
    /// `largest`: [bytes] a longer body from the other end is a fault, before it is read.
    FrameChannel(int descriptor, std::size_t largest);
    ~FrameChannel();
    FrameChannel(FrameChannel&& other) noexcept;
    FrameChannel(const FrameChannel&) = delete;
    FrameChannel& operator=(const FrameChannel&) = delete;
    FrameChannel& operator=(FrameChannel&&) = delete;

    /// Waits until all is handed over. `handed_over`: a descriptor that the other process gets
    /// with the message, where the socket carries them. Throws ChannelFault.
    void send(Kind kind,
              std::span<const std::uint8_t> body,
              const Patience& patience = {},
              int handed_over = -1);

    /// Waits for the next message as send() does. Throws ChannelFault, also for a body that is no
    /// table of its kind.
    Frame receive(const Patience& patience = {});

    /// Nobody else reads this socket, and no descriptor comes any more: from now on a message about
    /// as long as the last is taken in one call. What is read too far is kept.
    void read_whole_messages() {
        reads_whole_messages_ = true;
        last_size_ = 0;
    }

    /// For so long [s] receive() polls from now on, before it sleeps.
    void poll_for(double longest) { polling_ = Polling(longest); }

    /// From now on messages go through the mailbox where they can.
    void use(std::unique_ptr<Mailbox> mailbox) { mailbox_ = std::move(mailbox); }

    /// Whether there is something to receive.
    bool has_input() const;

    int descriptor() const { return descriptor_; }

    /// Whether open files can be handed over: between processes of one machine only.
    bool carries_descriptors() const;

  private:
    friend void wait_for_any_input(std::span<const int> descriptors, const Patience& patience);
    struct Wait;

    void send_through_socket(Kind kind,
                             std::span<const std::uint8_t> body,
                             const Patience& patience,
                             int handed_over);

    /// A letter, unless there is something to read first.
    std::optional<Frame> receive_letter(const Wait& wait);
    void await_letter(const Wait& wait);
    Frame receive_from_socket(const Wait& wait);
    bool socket_has_input() const;

    /// Until there is something to read.
    void await_input(const Wait& wait);

    /// What there is, once there is something. `came_along` gets a descriptor that comes with it.
    std::size_t read_some(void* target, std::size_t most, const Wait& wait, Descriptor& came_along);
    void read(void* target, std::size_t size, const Wait& wait, Descriptor& came_along);

    int descriptor_;
    std::size_t largest_;
    std::unique_ptr<Mailbox> mailbox_;
    Polling polling_;
    bool reads_whole_messages_ = false;
    std::size_t last_size_ = 0;       ///< [bytes] of the last body, as far as it is read ahead
    std::vector<std::uint8_t> room_;  ///< holds what is read, and of no message yet:
    std::size_t ahead_begin_ = 0;
    std::size_t ahead_end_ = 0;
};

}  // namespace reprise::remote

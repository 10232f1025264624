#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "remote/shared_memory.h"
#include "remote/wire_generated.h"

namespace reprise::remote {

/// Beside a socket, memory in which each end of the wire lays its next message for the other one:
/// as long as neither sleeps, no call of the system. A message lies there only where the other end
/// is awake and has received all that was said before; else it is to go through the socket, which
/// wakes it. So messages stay in their order. The driver makes it, and hands it over with `ready`.
class Mailbox {
  public:
    static constexpr std::size_t to_driver = std::size_t{1} << 20;  // [bytes] of a body, at most
    static constexpr std::size_t to_run = std::size_t{4} << 10;

    /// [bytes] of the memory.
    static std::size_t bytes();

    /// The driver's end. Throws world::Error where there is no memory.
    Mailbox();

    /// The run's, of what a driver handed over. Throws world::Error where that is no such memory.
    explicit Mailbox(Descriptor descriptor);

    int descriptor() const { return memory_.descriptor(); }

    /// Lays a message there. False: it is to go through the socket. A driver uses it only once it
    /// has found a message there: a run may not look.
    bool put(Kind kind, std::span<const std::uint8_t> body);

    /// A message went through the socket.
    void sent() { ++sent_; }

    /// One has come, wherever.
    void received();

    bool has_letter() const;

    struct Letter {
        Kind kind = Kind::goodbye;
        std::vector<std::uint64_t> words;  ///< the body, as it was when it was copied
        std::size_t size = 0;              ///< [bytes] of it
    };

    /// The message that lies there, if any does.
    std::optional<Letter> take();

    /// Before one waits for the socket alone, and behind it. What comes in between comes there.
    /// Ask for letters once more, when this has been said.
    void sleep(bool sleeps);

  private:
    struct Place;
    struct Places;

    Place& own() const;
    Place& others() const;

    SharedMemory memory_;
    Places* places_;
    bool is_run_;
    bool is_used_;  ///< by the other end as well
    std::uint32_t sent_ = 0;
    std::uint32_t received_ = 0;
};

}  // namespace reprise::remote

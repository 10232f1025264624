// Memory that a run and a driver write messages into.
//   must      hand over each message once, in order, and never leave one with who sleeps
//   assumes   one process at each end. The other one may write anything there at any time: what is
//             read is copied before anybody looks at it
//   goes      the number of a message is stored when its body is there. Who is about to sleep says
//             so and looks once more; who has laid one looks whether the other one sleeps, and
//             takes it back then. One of the two sees the other: all is in one order.
//   keeps     how many messages went and came
#include "remote/mailbox.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <utility>

namespace reprise::remote {

/// For messages in one direction.
struct Mailbox::Place {
    std::atomic<std::uint32_t> lies;      ///< number of the message there, from 1; 0: none
    std::atomic<std::uint32_t> received;  ///< by who reads here: number of the last, from anywhere
    std::atomic<std::uint32_t> sleeps;    ///< who reads here
    std::uint32_t kind;
    std::uint32_t size;  ///< [bytes]
};

struct Mailbox::Places {
    alignas(64) Place of_driver;  ///< to it
    alignas(64) Place of_run;
    alignas(64) std::array<std::uint8_t, Mailbox::to_driver> to_driver;
    alignas(64) std::array<std::uint8_t, Mailbox::to_run> to_run;
};

static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "two processes use it");

std::size_t Mailbox::bytes() {
    return sizeof(Places);
}

// All zero, as new memory is, is what there is before the first message.
Mailbox::Mailbox()
    : memory_(bytes()),
      places_(reinterpret_cast<Places*>(memory_.writable().data())),
      is_run_(false),
      is_used_(false) {}

Mailbox::Mailbox(Descriptor descriptor)
    : memory_(std::move(descriptor), bytes(), SharedMemory::Use::write),
      places_(reinterpret_cast<Places*>(memory_.writable().data())),
      is_run_(true),
      is_used_(true) {}

Mailbox::Place& Mailbox::own() const {
    return is_run_ ? places_->of_run : places_->of_driver;
}

Mailbox::Place& Mailbox::others() const {
    return is_run_ ? places_->of_driver : places_->of_run;
}

bool Mailbox::put(Kind kind, std::span<const std::uint8_t> body) {
    Place& place = others();
    const std::size_t room = is_run_ ? to_driver : to_run;
    if (!is_used_ || body.size() > room || place.received != sent_)
        return false;
    std::copy(
        body.begin(), body.end(), is_run_ ? places_->to_driver.data() : places_->to_run.data());
    place.kind = static_cast<std::uint32_t>(kind);
    place.size = static_cast<std::uint32_t>(body.size());
    std::uint32_t number = sent_ + 1;
    place.lies = number;
    if (place.sleeps != 0 && place.lies.compare_exchange_strong(number, 0))
        return false;
    ++sent_;
    return true;
}

void Mailbox::received() {
    own().received = ++received_;
}

bool Mailbox::has_letter() const {
    return own().lies == received_ + 1;
}

std::optional<Mailbox::Letter> Mailbox::take() {
    Place& place = own();
    std::uint32_t number = received_ + 1;
    if (!place.lies.compare_exchange_strong(number, 0))
        return std::nullopt;
    Letter letter;
    letter.kind = static_cast<Kind>(place.kind);
    letter.size = std::min<std::size_t>(place.size, is_run_ ? to_run : to_driver);
    letter.words.resize((letter.size + 7) / 8);
    const auto* body = is_run_ ? places_->to_run.data() : places_->to_driver.data();
    if (letter.size > 0)
        std::memcpy(letter.words.data(), body, letter.size);
    is_used_ = true;
    received();
    return letter;
}

void Mailbox::sleep(bool sleeps) {
    own().sleeps = sleeps ? 1 : 0;
}

}  // namespace reprise::remote

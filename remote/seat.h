#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "remote/frame_channel.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::remote {

/// Who is to drive an actor, as the user says it: ego='python3 my_driver.py', which is started, or
/// ego=socket:PATH, where a driver that runs already comes to us.
struct SeatPlan {
    std::string actor;
    std::string command{};           ///< for the shell; empty: it comes to `socket`
    std::filesystem::path socket{};  ///< a path where nothing is yet
};

/// Throws world::Error, "--driver ego: expected NAME=COMMAND or NAME=socket:PATH".
SeatPlan parse_seat(const std::string& text);

/// Why a driver drives no longer, in words for people, such as "its program ended with exit code
/// 1".
struct Lost {
    std::string reason;
};

/// The place at the wheel that a driver in another program takes. The run goes tick by tick with
/// it: show() what was recorded, then wait for its answer().
class Seat {
  public:
    /// Starts the program, or makes the socket, open for this user only. `patience`: for each
    /// answer. Throws world::Error.
    Seat(const SeatPlan& plan, Patience patience);
    ~Seat();
    Seat(const Seat&) = delete;
    Seat& operator=(const Seat&) = delete;

    const std::string& actor() const;

    /// The vehicle is there, with this id: says hello, and waits for the driver to be ready.
    std::optional<Lost> take(std::uint32_t id, const world::Recording& recording);

    /// Its id, once taken.
    std::optional<std::uint32_t> id() const;

    /// Hands over a tick. Does not wait for what the driver makes of it.
    std::optional<Lost> show(const world::SealedTick& tick);

    /// What the driver makes of the first tick that was shown and not answered yet.
    std::variant<world::Control, Lost> answer();

    /// The run is over, or the vehicle gone: says goodbye.
    void leave(const std::string& reason);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace reprise::remote

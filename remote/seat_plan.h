#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace reprise::remote {

/// Who is to drive an actor, as the user says it: ego='python3 my_driver.py', which is started, or
/// ego=socket:PATH or ego=tcp:PORT, where a driver that runs already comes to us.
struct SeatPlan {
    std::string actor;
    std::string command{};                ///< for the shell; empty: it comes to us
    std::filesystem::path socket{};       ///< a path where nothing is yet
    std::optional<std::uint16_t> port{};  ///< of this machine; 0: one that is free
};

/// Throws world::Error, "--driver ego: expected NAME=COMMAND, NAME=socket:PATH or NAME=tcp:PORT".
SeatPlan parse_seat(const std::string& said);

}  // namespace reprise::remote

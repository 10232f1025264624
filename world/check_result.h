#pragma once

#include <cstdint>
#include <string>

namespace reprise::world {

/// What became of something that a scenario promised with a `check` word.
struct CheckResult {
    enum class Status : std::uint8_t { pass, fail, not_evaluated };

    std::string name;
    Status status = Status::not_evaluated;
    std::uint64_t tick = 0;  ///< that records the first failure: the one after that it happened in
    std::string detail;
    std::string worst;  ///< of a failed one, how bad it became: "worst 9.5 at 4.55 s"; may be empty
    std::uint32_t line = 0;  ///< of the script
};

}  // namespace reprise::world

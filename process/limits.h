#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace reprise::process {

/// What a child may use before it is stopped; what is not named, as much as we may.
struct Limits {
    std::optional<std::uint64_t> memory{};   ///< [bytes] of address space
    std::optional<std::uint64_t> seconds{};  ///< of processor time
    std::optional<std::uint64_t> file{};     ///< [bytes] of one file that it writes
};

/// In a child: from here on, also for what it starts. Safe between fork and exec.
void impose(const Limits& limits);

/// Why a signal ended a child, such as "was stopped: it needed more than 600 s of processor time"
/// or "crashed (signal 11, Segmentation fault)".
std::string reason(int signal, const Limits& limits);

}  // namespace reprise::process

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "world/episode_generated.h"

namespace reprise::cli {

/// The shortest decimal that reads back the same.
std::string decimal(double value);

/// One word as a POSIX shell takes it: in quotes only where it needs them.
std::string shell_word(const std::string& word);

/// A path as a word; one that begins with a dash is not taken for an option.
std::string shell_path(const std::filesystem::path& path);

/// The command that makes this run again, to be given in the scenario's folder. `ticks`: its
/// length. An input that was not recorded (--nudge) is not part of it.
std::string run_command(const world::EpisodeT& episode, std::uint64_t ticks);

/// The same from the trace alone, wherever one is.
std::string rerun_command(const std::filesystem::path& trace,
                          const world::EpisodeT& episode,
                          std::uint64_t ticks);

/// Just beyond this tick, and no further than the run went.
std::uint64_t length_beyond(const world::EpisodeT& episode, std::uint64_t tick);

/// reprise recover IN -o OUT: for a.mcap.partial OUT is a.mcap, else a_recovered.mcap.
std::string recover_command(const std::filesystem::path& damaged);

}  // namespace reprise::cli

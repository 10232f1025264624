#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/kernel.h"
#include "remote/frame_channel.h"
#include "world/recording.h"

namespace reprise::cli {

/// One episode with a client at the wheel of 'ego', or of all `drivers`, in a process of its own:
/// steps a new kernel until the run is over, the client is gone or says something else than a
/// control, or a signal asks us to end. Writes the trace, whole, before the client hears of the
/// end. What went wrong is told to the client, with files named as in `folder`. Returns what it
/// said in place of a control.
std::optional<remote::Frame> play_episode(kernel::Kernel& kernel,
                                          const world::Recording& recording,
                                          const remote::FrameChannel& client,
                                          const std::vector<std::string>& drivers,
                                          const std::filesystem::path& trace,
                                          const std::filesystem::path& folder);

/// [1, ...] the line of the scenario that a message such as "my.lua:3: ..." names; 0: none.
std::uint32_t line_named_in(const std::string& message);

}  // namespace reprise::cli

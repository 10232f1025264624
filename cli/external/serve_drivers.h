#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "remote/frame_channel.h"
#include "world/recording.h"

namespace reprise::cli {

/// The actors that a client drives over channels of their own, by name; none: it drives 'ego' over
/// its connection. Throws world::Error for names that cannot be, and where `client` cannot be
/// handed channels.
std::vector<std::string> drivers_of(const remote::Reset& reset, const remote::FrameChannel& client);

/// For the driver of one of them: the other end goes to the client.
remote::FrameChannel channel_for(const std::string& name, remote::FrameChannel& client);

/// Whether the client says something on its own connection: it wants no more of the episode.
bool is_left(const remote::FrameChannel& client);

/// Whether that is that it has hung up.
bool has_gone(const remote::FrameChannel& client);

/// The last word of their episode, on the client's own connection, which may be gone.
/// `line` of the scenario, or 0.
void say_end(remote::FrameChannel& client, const world::Outcome& outcome);
void say_fault(remote::FrameChannel& client, const std::string& text, std::uint32_t line);

}  // namespace reprise::cli

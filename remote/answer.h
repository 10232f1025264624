// Private to the room.
#pragma once

#include <cstdint>
#include <string>

#include "remote/frame_channel.h"

/// What a driver says for itself is foreign: looked at before it is believed or shown.
namespace reprise::remote {

/// What is wrong with its answer to the tick that it was shown, or "".
std::string fault_of(const Control& control, std::uint64_t shown);

/// What a driver says of itself, for one line of ours.
std::string shortened(const flatbuffers::String& text);

}  // namespace reprise::remote

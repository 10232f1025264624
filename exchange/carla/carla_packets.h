// Private to the room: the packets of a CARLA log, one by one.
#pragma once

#include <cstdint>
#include <string>

#include "exchange/carla/carla_frame.h"
#include "replay/mcap/mcap.h"

namespace reprise::exchange {

/// A text with its length before it. Printable ASCII, as CARLA's names are, and 200 characters at
/// most: what a damaged log says goes into messages and JSON.
std::string read_carla_text(replay::mcap::Decoder& in);

/// How long a packet with so many positions is.
std::uint64_t position_packet_size(std::uint64_t records, CarlaVariant variant);

/// Adds what a packet says to its frame. False when it holds something that is not read. Throws
/// mcap::Malformed.
bool read_carla_packet(std::uint8_t kind,
                       replay::mcap::View content,
                       CarlaVariant variant,
                       CarlaFrame& frame);

}  // namespace reprise::exchange

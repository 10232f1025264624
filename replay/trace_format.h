#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "replay/mcap/mcap.h"
#include "world/recording.h"

/// What is where in a trace. An MCAP file with, in this order:
///   metadata    reprise.run        who, where, which seed: for people and tools; follows from the
///                                  episode, and is compared with it
///   attachments episode.bin, scenario/main.lua, town.bin.zst, town.net.xml.zst
///   chunks      of 64 ticks: /sim/tick and /sim/traffic in turn; log time = tick * step
///   metadata    reprise.outcome    how it ended, the last link of the chain, the episode's digest
///   the summary (index) that MCAP asks for
/// Nothing else, and each record in one way only: what differs from it was not written by us.
/// A slice of a run says so in reprise.run: slice.first_tick, slice.run_ticks, slice.chain_before,
/// and slice.spawn.ACTOR for each who was there before: see trace_facts.h.
namespace reprise::replay::format {

/// Counted up with every change of this layout or of a schema in world/*.fbs: until 1.0 a trace of
/// another version is refused.
inline constexpr std::uint64_t version = 10;
inline constexpr std::uint64_t ticks_per_chunk = 64;
inline constexpr std::uint16_t tick_channel = 1;
inline constexpr std::uint16_t traffic_channel = 2;
inline constexpr const char* run_metadata = "reprise.run";
inline constexpr const char* outcome_metadata = "reprise.outcome";
inline constexpr const char* episode_attachment = "episode.bin";
inline constexpr const char* scenario_attachment = "scenario/main.lua";
inline constexpr const char* town_attachment = "town.bin.zst";
inline constexpr const char* network_attachment = "town.net.xml.zst";

/// MCAP puts no checksum on metadata; ours carry one of their own, under the key "check".
std::map<std::string, std::string> with_check(std::map<std::string, std::string> texts);
bool check_holds(const std::map<std::string, std::string>& texts);

/// The FlatBuffers bytes of the episode and the town: equal nouns, equal bytes.
mcap::Bytes pack(const world::EpisodeT& episode);
mcap::Bytes pack(const world::TownT& town);

/// 32 hexadecimal digits as world::to_hex writes them. Zero when it is no such text.
world::Digest128 from_hex(const std::string& text);

}  // namespace reprise::replay::format

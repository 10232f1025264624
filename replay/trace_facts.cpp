#include "replay/trace_facts.h"

#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "replay/level.h"
#include "replay/mcap/aligned_copy.h"
#include "replay/noun_check.h"
#include "replay/trace_format.h"

namespace reprise::replay {

namespace {

constexpr std::string_view spawn_key = "slice.spawn.";

mcap::Bytes packed(const world::CommandT& command) {
    flatbuffers::FlatBufferBuilder builder(256);
    builder.Finish(world::Command::Pack(builder, &command));
    return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

/// Only digits, and all of them.
template <typename Number>
std::optional<Number> number_in(std::string_view text, int base) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data(), end, number, base);
    if (read.ec != std::errc() || read.ptr != end)
        return std::nullopt;
    return number;
}

std::optional<mcap::Bytes> bytes_in(std::string_view digits) {
    if (digits.size() % 2 != 0)
        return std::nullopt;
    mcap::Bytes bytes;
    bytes.reserve(digits.size() / 2);
    for (std::size_t at = 0; at < digits.size(); at += 2) {
        const auto byte = number_in<std::uint8_t>(digits.substr(at, 2), 16);
        if (!byte)
            return std::nullopt;
        bytes.push_back(*byte);
    }
    return bytes;
}

/// Nothing for what is no spawn of this actor before that tick. Whether it is written as a run
/// writes it is seen where it is written again.
std::optional<world::Spawn> spawn_in(std::string_view text,
                                     std::uint32_t actor,
                                     std::uint64_t first) {
    const auto space = text.find(' ');
    if (space == std::string_view::npos)
        return std::nullopt;
    const auto tick = number_in<std::uint64_t>(text.substr(0, space), 10);
    const auto bytes = bytes_in(text.substr(space + 1));
    if (!tick || *tick < 1 || *tick >= first || !bytes)
        return std::nullopt;
    AlignedCopy copy;
    const mcap::View command = copy.of(*bytes);
    if (fault_of_command(command))
        return std::nullopt;
    world::Spawn spawn;
    flatbuffers::GetRoot<world::Command>(command.data())->UnPackTo(&spawn.command);
    spawn.tick = *tick;
    if (spawn.command.kind != world::CommandKind::spawn || spawn.command.actor != actor)
        return std::nullopt;
    return spawn;
}

}  // namespace

Facts run_facts(const world::EpisodeT& episode,
                const world::Digest128& seed_of_chain,
                Level level,
                const std::optional<world::SliceStart>& slice) {
    Facts facts{
        {"format", std::to_string(format::version)},
        {"name", episode.name},
        {"scenario", episode.scenario_path},
        {"town", episode.town},
        {"seed", std::to_string(episode.seed)},
        {"step_ns", std::to_string(episode.step_ns)},
        {"substeps", std::to_string(episode.substeps)},
        {"max_ticks", std::to_string(episode.max_ticks)},
        {"cars", std::to_string(episode.cars)},
        {"road_friction", fmt::format("{}", episode.road_friction)},
        {"weather", episode.weather_name},
        {"chain_seed", world::to_hex(seed_of_chain)},
    };
    if (episode.walkers > 0) {
        facts["walkers"] = std::to_string(episode.walkers);
        facts["walker_seed"] = std::to_string(episode.walker_seed);
        facts["jaywalkers"] = fmt::format("{}", episode.jaywalkers);
    }
    if (!episode.imported_from.empty())
        facts["imported_from"] = episode.imported_from;
    if (level != Level::full)
        facts["level"] = to_word(level);
    if (slice) {
        facts["slice.first_tick"] = std::to_string(slice->first);
        facts["slice.run_ticks"] = std::to_string(slice->run_ticks);
        facts["slice.chain_before"] = world::to_hex(slice->chain_before);
        add_spawns(slice->spawns, facts);
    }
    if (!episode.branches.empty()) {
        const world::BranchT& branch = episode.branches.back();
        facts["branch.tick"] = std::to_string(branch.tick);
        facts["branch.scenario"] = branch.scenario_path;
        facts["branch.parent_chain"] = world::to_hex(branch.parent_chain);
    }
    for (const world::ParameterT& parameter : episode.parameters)
        facts["set." + parameter.key] = parameter.value;
    for (const world::ParameterT& line : episode.fingerprint)
        facts["build." + line.key] = line.value;
    return facts;
}

Facts outcome_facts(const world::Outcome& outcome,
                    const world::Digest128& last_chain,
                    mcap::View episode) {
    return {
        {"verdict", outcome.verdict},
        {"reason", outcome.reason},
        {"ticks", std::to_string(outcome.ticks)},
        {"chain", world::to_hex(last_chain)},
        {"episode",
         world::to_hex(
             world::digest128({reinterpret_cast<const char*>(episode.data()), episode.size()}))},
    };
}

void add_spawns(const world::Spawns& spawns, Facts& facts) {
    for (const auto& [actor, spawn] : spawns)
        facts[fmt::format("{}{}", spawn_key, actor)] =
            fmt::format("{} {:02x}", spawn.tick, fmt::join(packed(spawn.command), ""));
}

std::optional<std::string> take_spawns(const Facts& facts,
                                       std::uint64_t first,
                                       world::Spawns& spawns) {
    for (auto fact = facts.lower_bound(std::string(spawn_key));
         fact != facts.end() && fact->first.starts_with(spawn_key);
         ++fact) {
        const auto& [key, text] = *fact;
        const auto actor =
            number_in<std::uint32_t>(std::string_view(key).substr(spawn_key.size()), 10);
        auto spawn = actor ? spawn_in(text, *actor, first) : std::nullopt;
        if (!spawn)
            return fmt::format("its '{}' is no spawn before tick {}", key, first);
        spawns[*actor] = std::move(*spawn);
    }
    return std::nullopt;
}

std::optional<std::string> first_other_fact(const Facts& written, const Facts& found) {
    const auto value = [](const Facts& facts, const std::string& key) {
        const auto entry = facts.find(key);
        return entry == facts.end() ? std::string("absent") : "'" + entry->second + "'";
    };
    Facts keys = written;
    keys.insert(found.begin(), found.end());
    for (const auto& [key, text] : keys)
        if (key != "check" && value(written, key) != value(found, key))
            return fmt::format(
                "{} is {}, where {} was written", key, value(found, key), value(written, key));
    return std::nullopt;
}

}  // namespace reprise::replay

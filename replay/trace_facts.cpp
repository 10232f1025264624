#include "replay/trace_facts.h"

#include <fmt/format.h>

#include "replay/level.h"
#include "replay/trace_format.h"

namespace reprise::replay {

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
    if (!episode.imported_from.empty())
        facts["imported_from"] = episode.imported_from;
    if (level != Level::full)
        facts["level"] = to_word(level);
    if (slice) {
        facts["slice.first_tick"] = std::to_string(slice->first);
        facts["slice.run_ticks"] = std::to_string(slice->run_ticks);
        facts["slice.chain_before"] = world::to_hex(slice->chain_before);
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

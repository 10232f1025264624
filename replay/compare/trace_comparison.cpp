// Two traces: what they started from, the first tick that differs, how they end.
#include <algorithm>

#include <fmt/format.h>

#include "replay/chain_seed.h"
#include "replay/compare/divergence.h"
#include "replay/compare/field_difference.h"
#include "replay/compare/tick_bytes.h"
#include "replay/slice.h"
#include "replay/trace_format.h"
#include "world/check.h"

namespace reprise::replay {

namespace {

/// Appends to a note whose parts are separated by semicolons.
void add_note(std::string& note, const std::string& part) {
    if (!part.empty())
        note += (note.empty() ? "" : "; ") + part;
}

/// What the chain leaves out: where the town's file lay, and who recorded it.
bool is_information(std::string_view field) {
    return field == "fingerprint" || field == "town_path" ||
           field == "branches";  // linked in where they begin: see branch_text
}

bool same_branches(const world::EpisodeT& expected, const world::EpisodeT& found) {
    return std::ranges::equal(expected.branches,
                              found.branches,
                              [](const world::BranchT& left, const world::BranchT& right) {
                                  return chain_of_branch({}, left) == chain_of_branch({}, right);
                              });
}

/// "seed 7 / 8, cars 100 / 50".
std::string list(const std::vector<FieldDifference>& differences) {
    constexpr std::size_t most = 4;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, differences.size()); ++i)
        text += fmt::format("{}{} {} / {}",
                            i == 0 ? "" : ", ",
                            differences[i].field,
                            differences[i].expected,
                            differences[i].found);
    if (differences.size() > most)
        text += fmt::format(" and {} more", differences.size() - most);
    return text;
}

/// What two runs did not have in common before the first tick, of what can change a run.
struct StartDifference {
    std::vector<FieldDifference> deciding;

    std::string note() const {
        return deciding.empty() ? "" : "the runs did not start from the same: " + list(deciding);
    }
};

StartDifference compare_starts(const world::EpisodeT& expected, const world::EpisodeT& found) {
    StartDifference start;
    const mcap::Bytes left = format::pack(expected);
    const mcap::Bytes right = format::pack(found);
    for (const std::string_view field : field_names(*world::EpisodeTypeTable())) {
        if (is_information(field))
            continue;
        auto some = differences(*world::EpisodeTypeTable(),
                                world::GetEpisode(left.data()),
                                world::GetEpisode(right.data()),
                                field);
        std::move(some.begin(), some.end(), std::back_inserter(start.deciding));
    }
    return start;
}

/// The first tick whose chain differs, by binary search: equal chains mean equal histories. Nothing
/// when the last common one is equal, or when damage or another's hand spoils the search.
std::optional<Divergence> first_different_link(TraceReader& expected, TraceReader& found) {
    std::uint64_t low = 0;  // equal here
    std::uint64_t high = std::min(expected.ticks(), found.ticks());
    const auto equal = [&](std::uint64_t tick) {
        return expected.chain(tick) == found.chain(tick);
    };
    const auto damaged = [&](std::uint64_t tick) {
        return expected.damage(tick) || found.damage(tick);
    };
    if (high == 0 || damaged(high) || equal(high))
        return std::nullopt;
    while (high - low > 1) {
        const std::uint64_t middle = low + (high - low) / 2;
        if (damaged(middle))
            return std::nullopt;
        (equal(middle) ? low : high) = middle;
    }
    auto divergence = compare(expected.recorded(high), found.recorded(high));
    if (divergence && divergence->stage == "start")
        return std::nullopt;  // a tick with the right state and the wrong chain
    return divergence;
}

/// The first tick that differs, and nothing when the shorter run is the longer one's beginning.
std::optional<Divergence> first_different_tick(TraceReader& expected,
                                               TraceReader& found,
                                               bool same_chain) {
    const std::uint64_t common = std::min(expected.ticks(), found.ticks());
    std::uint64_t index = 1;
    while (index <= common) {
        const PackedTicks left = expected.packed(index);
        const PackedTicks right = found.packed(index);
        const std::uint64_t last = std::min(left.last, right.last);
        if (left.first == right.first && std::ranges::equal(left.bytes, right.bytes)) {
            index = last + 1;
            continue;
        }
        for (; index <= std::min(last, common); ++index) {
            const RecordedTick left_tick = expected.recorded(index);
            const RecordedTick right_tick = found.recorded(index);
            const bool equal = same_chain ? equal_ticks(left_tick, right_tick)
                                          : equal_ticks_but_for_chain(left_tick, right_tick);
            if (!equal)
                return compare(left_tick, right_tick);
        }
    }
    return std::nullopt;
}

/// Follows a difference that shows only in a digest until it shows in the record.
void find_first_recorded(Divergence& divergence, TraceReader& expected, TraceReader& found) {
    const std::uint64_t common = std::min(expected.ticks(), found.ticks());
    const std::uint64_t last = std::min(common, divergence.tick + longest_search);
    std::optional<Divergence> recorded;
    std::uint64_t index = divergence.tick;
    while (!recorded && index < last && !expected.damage(index + 1) && !found.damage(index + 1)) {
        ++index;
        recorded = compare_recorded(expected.recorded(index), found.recorded(index));
    }
    add_first_recorded(divergence, recorded, index - divergence.tick);
}

std::optional<Divergence> compare_ends(const TraceReader& expected, const TraceReader& found) {
    Divergence divergence;
    divergence.stage = "end";
    if (expected.ticks() != found.ticks()) {
        const auto text = [](const TraceReader& trace) {
            return fmt::format("{} ({}{}{})",
                               trace.ticks(),
                               trace.outcome().verdict,
                               trace.outcome().reason.empty() ? "" : ": ",
                               trace.outcome().reason);
        };
        divergence.tick = std::min(expected.ticks(), found.ticks()) + 1;
        divergence.field = "ticks";
        divergence.expected = text(expected);
        divergence.found = text(found);
        divergence.note = "the ticks that both have are equal";
        return divergence;
    }
    divergence.tick = expected.ticks();
    const auto differs = [&](const char* field, const std::string& left, const std::string& right) {
        divergence.field = field;
        divergence.expected = left;
        divergence.found = right;
        return left != right;
    };
    if (differs("outcome.verdict", expected.outcome().verdict, found.outcome().verdict) ||
        differs("outcome.reason", expected.outcome().reason, found.outcome().reason))
        return divergence;
    return std::nullopt;
}

/// All ticks are equal though the runs started from different things.
Divergence only_starts_differ(TraceReader& expected,
                              TraceReader& found,
                              const StartDifference& start) {
    Divergence divergence;
    divergence.stage = "start";
    if (expected.chain(0) == found.chain(0)) {
        divergence.field = "branches";
        divergence.expected = fmt::format("{} of them", expected.episode().branches.size());
        divergence.found = fmt::format("{} of them", found.episode().branches.size());
        divergence.note = branch_text(expected.episode(), found.episode());
        add_note(divergence.note, "all ticks are equal nevertheless");
        return divergence;
    }
    if (!start.deciding.empty()) {
        divergence.field = start.deciding.front().field;
        divergence.expected = start.deciding.front().expected;
        divergence.found = start.deciding.front().found;
    } else {
        const bool same_network = expected.recording().network == found.recording().network;
        divergence.field = same_network ? "town" : "network";
    }
    divergence.note = expected.ticks() == 0
                          ? "neither run has a tick"
                          : fmt::format("all {} ticks are equal nevertheless", expected.ticks());
    return divergence;
}

/// "distance = 10, gap = 2"; without any it is another driver.
std::string settings_text(const world::BranchT& branch) {
    if (branch.parameters.empty())
        return "another driver";
    std::string text;
    for (const world::ParameterT& parameter : branch.parameters)
        text += (text.empty() ? "" : ", ") + parameter.key + " = " + parameter.value;
    return text;
}

void check_undamaged(TraceReader& trace) {
    if (const auto damage = trace.damage())
        throw world::Error(trace.path().string() + ": " + *damage);
}

}  // namespace

std::string branch_text(const world::EpisodeT& expected, const world::EpisodeT& found) {
    const auto parted = std::mismatch(expected.branches.begin(),
                                      expected.branches.end(),
                                      found.branches.begin(),
                                      found.branches.end(),
                                      [](const world::BranchT& left, const world::BranchT& right) {
                                          return left.tick == right.tick &&
                                                 left.scenario == right.scenario &&
                                                 left.parameters == right.parameters &&
                                                 left.max_ticks == right.max_ticks;
                                      });
    std::string text;
    const auto add = [&](const world::BranchT& branch, const char* which) {
        text += fmt::format("{}{}branched at tick {} ({:.2f} s) by {}",
                            text.empty() ? "" : "; ",
                            which,
                            branch.tick,
                            world::seconds(branch.tick, expected.step_ns),
                            branch.scenario.empty() ? settings_text(branch) : branch.scenario_path);
    };
    const bool both =
        parted.first != expected.branches.end() && parted.second != found.branches.end();
    if (parted.first != expected.branches.end())
        add(*parted.first, "the expected run ");
    if (parted.second != found.branches.end())
        add(*parted.second, both ? "the found run " : "");
    return text;
}

std::optional<Divergence> compare(TraceReader& expected, TraceReader& found) {
    require_start_of_run(expected);
    require_start_of_run(found);
    const bool same_start = expected.chain(0) == found.chain(0);
    const bool same_chain = same_start && same_branches(expected.episode(), found.episode());
    const StartDifference start = compare_starts(expected.episode(), found.episode());
    std::optional<Divergence> divergence;
    if (same_start)
        divergence = first_different_link(expected, found);
    if (!divergence)
        divergence = first_different_tick(expected, found, same_chain);
    if (!divergence)
        divergence = compare_ends(expected, found);
    if (divergence) {
        if (divergence->unrecorded)
            find_first_recorded(*divergence, expected, found);
        add_context(*divergence, expected);
        add_note(divergence->note, start.note());
        return divergence;
    }
    check_undamaged(expected);
    check_undamaged(found);
    if (same_chain)
        return std::nullopt;
    divergence = only_starts_differ(expected, found, start);
    add_note(divergence->note, start.note());
    return divergence;
}

std::optional<Divergence> compare(TraceReader& expected, TraceReader& found, Tolerance& tolerance) {
    require_start_of_run(expected);
    require_start_of_run(found);
    const std::uint64_t common = std::min(expected.ticks(), found.ticks());
    std::optional<Divergence> divergence;
    for (std::uint64_t index = 1; index <= common && !divergence; ++index) {
        const RecordedTick left = expected.recorded(index);
        const RecordedTick right = found.recorded(index);
        if (!equal_ticks(left, right))
            divergence = compare_recorded(left, right, &tolerance);
    }
    if (!divergence)
        divergence = compare_ends(expected, found);
    if (divergence) {
        add_context(*divergence, expected);
        add_note(divergence->note, start_difference(expected, found));
        return divergence;
    }
    check_undamaged(expected);
    check_undamaged(found);
    return std::nullopt;
}

std::string start_difference(const TraceReader& expected, const TraceReader& found) {
    return compare_starts(expected.episode(), found.episode()).note();
}

std::string town_path_difference(const TraceReader& expected, const TraceReader& found) {
    const std::string& left = expected.episode().town_path;
    const std::string& right = found.episode().town_path;
    return left == right ? "" : fmt::format("their towns were read from '{}' / '{}'", left, right);
}

}  // namespace reprise::replay

#include "replay/opened_trace.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "replay/level.h"
#include "replay/noun_check.h"
#include "replay/trace_facts.h"
#include "replay/trace_format.h"
#include "world/check.h"

namespace reprise::replay {

namespace {

std::uint64_t to_number(const std::string& text) {
    std::uint64_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

}  // namespace

OpenedTrace::OpenedTrace(const std::filesystem::path& path, bool salvage) : input(path) {
    index = find_index(salvage);
    if (!index.whole && find_attachment(index, format::episode_attachment) == nullptr)
        input.fail(index.data_end,
                   "cut off before the first tick: nothing in it can be used; record again");
    read_start();
    if (index.whole && !salvage) {
        find_ranges();
        check_end_of_slice();
        read_outcome();
        return;
    }
    drop_broken_end();
    check_end_of_slice();
    if (!salvage)
        input.fail(index.data_end, cut_off());
    salvage_outcome();
}

TraceIndex OpenedTrace::find_index(bool salvage) const {
    try {
        if (auto found = read_index(input))
            return std::move(*found);
    } catch (const world::Error&) {
        if (!salvage)
            throw;
    }
    return scan(input);
}

void OpenedTrace::read_start() {
    const auto facts = read_metadata(input, index, format::run_metadata);
    if (!facts)
        input.fail(0, "an MCAP file, but not a trace of Reprise: it has no 'reprise.run'");
    const auto format_of = facts->find("format");
    const std::uint64_t version = format_of == facts->end() ? 0 : to_number(format_of->second);
    if (version != format::version)
        input.fail(0,
                   fmt::format("a trace of format {}; this program reads format {}: record the run "
                               "again, or use the program that recorded it",
                               version,
                               format::version));
    if (const auto word = facts->find("level"); word != facts->end())
        read_level(word->second);
    if (const auto seed = facts->find("chain_seed"); seed != facts->end())
        first_chain = format::from_hex(seed->second);
    slice.chain_before = first_chain;
    if (facts->contains("slice.first_tick"))
        read_slice(*facts);
    const mcap::Bytes bytes = read_attachment(input, index, format::episode_attachment);
    AlignedCopy copy;
    const mcap::View episode = copy.of(bytes);
    if (const auto fault = fault_of_episode(episode))
        fail_attachment(format::episode_attachment, *fault);
    world::GetEpisode(episode.data())->UnPackTo(&recording.episode);
    if (!std::ranges::equal(format::pack(recording.episode), bytes))
        fail_attachment(format::episode_attachment, "not as a run writes it");
    compare_facts(format::run_metadata,
                  run_facts(recording.episode,
                            first_chain,
                            level,
                            slice.run_ticks > 0 ? std::optional(slice) : std::nullopt),
                  *facts);
}

void OpenedTrace::compare_facts(const char* name, const Facts& written, const Facts& found) const {
    if (const auto other = first_other_fact(written, found))
        input.fail(
            find_metadata(index, name)->offset,
            fmt::format("the metadata '{}' was changed after it was recorded: {}", name, *other));
}

void OpenedTrace::read_level(const std::string& word) {
    const auto named = level_named(word);
    if (!named)
        input.fail(0, fmt::format("its level is '{}', which this program does not know", word));
    level = *named;
}

void OpenedTrace::read_slice(const std::map<std::string, std::string>& facts) {
    const auto text = [&](const char* key) {
        const auto found = facts.find(key);
        return found == facts.end() ? std::string() : found->second;
    };
    slice = {to_number(text("slice.first_tick")),
             to_number(text("slice.run_ticks")),
             format::from_hex(text("slice.chain_before")),
             {}};
    if (slice.first < 1 || slice.first > slice.run_ticks)
        input.fail(0, "a slice of a run, but not one that says where it begins");
    if (const auto fault = take_spawns(facts, slice.first, slice.spawns))
        input.fail(find_metadata(index, format::run_metadata)->offset,
                   "a slice of a run that says wrongly who was there before: " + *fault);
}

void OpenedTrace::check_end_of_slice() const {
    if (slice.run_ticks != 0 && last() > slice.run_ticks)
        input.fail(0,
                   fmt::format(
                       "a slice that holds tick {} of a run of {} ticks", last(), slice.run_ticks));
}

void OpenedTrace::fail_attachment(const std::string& name, const std::string& fault) {
    input.fail(find_attachment(index, name)->offset,
               fmt::format("the attachment '{}' is damaged ({})", name, fault));
}

void OpenedTrace::find_ranges() {
    for (const mcap::Chunk& chunk : index.chunks) {
        const auto range = range_of(chunk);
        if (!range)
            input.fail(chunk.offset,
                       fmt::format("the index is damaged: after tick {} comes a chunk of "
                                   "times {} to {} ns",
                                   last(),
                                   chunk.start_time,
                                   chunk.end_time));
        ranges.push_back(*range);
    }
}

std::optional<TickRange> OpenedTrace::range_of(const mcap::Chunk& chunk) const {
    const TickRange range{chunk.start_time / step_ns(), chunk.end_time / step_ns()};
    // One message a tick bounds the count: it sizes a table when the chunk is read.
    const std::uint64_t most = chunk.uncompressed_size / (mcap::prefix_size + mcap::message_header);
    // Chunks begin and end at whole multiples, so that equal ticks lie in equal chunks.
    constexpr std::uint64_t whole = format::ticks_per_chunk;
    if (range.first == 0 || (!ranges.empty() && (range.first - 1) % whole != 0) ||
        (range.first - 1) / whole != (range.last - 1) / whole)
        return std::nullopt;
    if (chunk.start_time % step_ns() != 0 || chunk.end_time % step_ns() != 0 ||
        range.first != last() + 1 || range.last < range.first || range.last - range.first >= most)
        return std::nullopt;
    return range;
}

void OpenedTrace::drop_broken_end() {
    for (std::size_t i = 0; i < index.chunks.size(); ++i) {
        const auto range = range_of(index.chunks[i]);
        if (range)
            loaded_chunk.load(input, index.chunks[i], *range, step_ns(), level);
        if (!range || loaded_chunk.damage()) {
            const std::string fault = range ? *loaded_chunk.damage() : "other times than due";
            loss = fmt::format(
                "byte {}: the chunk behind tick {} is damaged ({}); it and the {} chunks "
                "behind it are left out, because a trace has no holes",
                index.chunks[i].offset,
                last(),
                fault,
                index.chunks.size() - i - 1);
            index.data_end = index.chunks[i].offset;
            index.chunks.resize(i);
            index.whole = false;
            return;
        }
        ranges.push_back(*range);
    }
}

void OpenedTrace::salvage_outcome() {
    try {
        read_outcome();
    } catch (const world::Error&) {
        index.whole = false;
        if (loss.empty())
            loss = fmt::format("byte {}: the file ends behind tick {}", index.data_end, last());
        outcome = world::outcome_of_cut_off(ticks());
    }
}

std::string OpenedTrace::cut_off() const {
    if (ticks() == 0)
        return "cut off before the first whole chunk of ticks; record the run again";
    return fmt::format(
        "cut off after tick {}: the end of the trace is missing, those {} ticks are whole; "
        "{}",
        last(),
        ticks(),
        slice.first > 1 ? "cut the slice again from the whole trace"
                        : "`reprise recover` makes a trace of them");
}

void OpenedTrace::read_outcome() {
    const auto facts = read_metadata(input, index, format::outcome_metadata);
    if (!facts)
        input.fail(0, "the trace does not say how the run ended ('reprise.outcome')");
    const auto text = [&](const char* key) {
        const auto found = facts->find(key);
        return found == facts->end() ? std::string() : found->second;
    };
    outcome = {text("verdict"), text("reason"), to_number(text("ticks"))};
    compare_facts(
        format::outcome_metadata,
        outcome_facts(outcome, format::from_hex(text("chain")), format::pack(recording.episode)),
        *facts);
    if (outcome.ticks != ticks())
        input.fail(
            index.data_end,
            fmt::format(
                "the index is damaged: it lists {} ticks, the run had {}", ticks(), outcome.ticks));
    const bool is_part = slice.run_ticks > 0 && last() < slice.run_ticks;
    if (is_part != (outcome.verdict == world::outcome_of_part(0).verdict))
        input.fail(find_metadata(index, format::outcome_metadata)->offset,
                   fmt::format("a slice without the run's end is a part, and nothing else is; this "
                               "says '{}'",
                               outcome.verdict));
}

std::size_t OpenedTrace::chunk_of(std::uint64_t tick) const {
    REPRISE_CHECK(tick >= slice.first && tick <= last(),
                  fmt::format("tick {} of a trace with {} to {}", tick, slice.first, last()));
    const auto after = std::upper_bound(
        ranges.begin(), ranges.end(), tick, [](std::uint64_t wanted, const TickRange& range) {
            return wanted < range.first;
        });
    return static_cast<std::size_t>(after - ranges.begin()) - 1;
}

void OpenedTrace::load(std::uint64_t tick) {
    const std::size_t i = chunk_of(tick);
    if (ranges[i].first == loaded)
        return;
    loaded = none_loaded;  // should reading throw
    loaded_chunk.load(input, index.chunks[i], ranges[i], step_ns(), level);
    loaded = ranges[i].first;
}

std::string OpenedTrace::describe_damage(std::uint64_t tick) const {
    const std::size_t i = chunk_of(tick);
    return fmt::format("the chunk of ticks {} to {} is damaged ({})",
                       ranges[i].first,
                       ranges[i].last,
                       *loaded_chunk.damage());
}

std::optional<std::string> OpenedTrace::take(std::uint64_t tick, RecordedTick& out) {
    const ChunkReader::Messages messages = loaded_chunk.messages(tick);
    if (!messages.complete(level, tick))
        return "it is missing";
    out.tick_bytes = tick_copy.of(messages.tick);
    if (const auto fault = level == Level::inputs ? fault_of_inputs(out.tick_bytes, tick)
                                                  : fault_of_tick(out.tick_bytes, tick))
        return fault;
    out.view.tick = world::GetTick(out.tick_bytes.data());
    if (!holds_traffic(level, tick))
        return std::nullopt;
    out.traffic_bytes = traffic_copy.of(messages.traffic);
    if (const auto fault = fault_of_traffic(out.traffic_bytes, tick))
        return fault;
    out.view.traffic = world::GetTraffic(out.traffic_bytes.data());
    return std::nullopt;
}

void OpenedTrace::read_town() {
    AlignedCopy copy;
    const mcap::View town = copy.of(read_packed_attachment(input, index, format::town_attachment));
    if (const auto fault = fault_of_town(town))
        fail_attachment(format::town_attachment, *fault);
    world::GetTown(town.data())->UnPackTo(&recording.town);
    const mcap::Bytes network = read_packed_attachment(input, index, format::network_attachment);
    recording.network.assign(network.begin(), network.end());
    has_town = true;
}

}  // namespace reprise::replay

#include "replay/trace_reader.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

#include "replay/chunk_reader.h"
#include "replay/level.h"
#include "replay/noun_check.h"
#include "replay/trace_format.h"
#include "replay/trace_index.h"
#include "world/check.h"

namespace reprise::replay {

namespace {

constexpr std::uint64_t none_loaded = 0;

std::uint64_t to_number(const std::string& text) {
    std::uint64_t value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// Message data lies anywhere in a chunk; FlatBuffers need it 8-aligned.
class AlignedCopy {
  public:
    mcap::View of(mcap::View bytes) {
        if (words_.size() * 8 < bytes.size())
            words_.resize(bytes.size() / 8 + 1);
        std::copy(bytes.begin(), bytes.end(), reinterpret_cast<std::uint8_t*>(words_.data()));
        return {reinterpret_cast<const std::uint8_t*>(words_.data()), bytes.size()};
    }

  private:
    std::vector<std::uint64_t> words_;
};

}  // namespace

struct TraceReader::File {
    InputFile input;
    TraceIndex index;
    std::vector<TickRange> ranges;  ///< of index.chunks, without gaps
    Recording recording;
    Level level = Level::full;
    bool has_town = false;  ///< recording.town and .network are read
    Outcome outcome;
    world::Digest128 first_chain;
    SliceStart slice;  ///< of a whole run: from tick 1 on, and no run_ticks
    std::string loss;  ///< what a salvage left out
    ChunkReader loaded_chunk;
    std::uint64_t loaded = none_loaded;  ///< first tick of the chunk in memory
    mcap::Bytes packed;                  ///< as handed out by packed()
    AlignedCopy tick_copy;
    AlignedCopy traffic_copy;

    File(const std::filesystem::path& path, bool salvage) : input(path) {
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

    TraceIndex find_index(bool salvage) const {
        try {
            if (auto found = read_index(input))
                return std::move(*found);
        } catch (const world::Error&) {
            if (!salvage)
                throw;
        }
        return scan(input);
    }

    std::uint64_t ticks() const { return last() + 1 - slice.first; }

    std::uint64_t last() const { return ranges.empty() ? slice.first - 1 : ranges.back().last; }

    std::uint64_t step_ns() const { return recording.episode.step_ns; }

    /// Who made it, and the episode.
    void read_start() {
        const auto facts = read_metadata(input, index, format::run_metadata);
        if (!facts)
            input.fail(0, "an MCAP file, but not a trace of Reprise: it has no 'reprise.run'");
        const auto format_of = facts->find("format");
        const std::uint64_t version = format_of == facts->end() ? 0 : to_number(format_of->second);
        if (version != format::version)
            input.fail(0,
                       fmt::format("the trace's format is {}, this program reads {}; use the "
                                   "program that recorded it, or a newer one",
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
    }

    void read_level(const std::string& word) {
        const auto named = level_named(word);
        if (!named)
            input.fail(0, fmt::format("its level is '{}', which this program does not know", word));
        level = *named;
    }

    void read_slice(const std::map<std::string, std::string>& facts) {
        const auto text = [&](const char* key) {
            const auto found = facts.find(key);
            return found == facts.end() ? std::string() : found->second;
        };
        slice = {to_number(text("slice.first_tick")),
                 to_number(text("slice.run_ticks")),
                 format::from_hex(text("slice.chain_before"))};
        if (slice.first < 1 || slice.first > slice.run_ticks)
            input.fail(0, "a slice of a run, but not one that says where it begins");
    }

    void check_end_of_slice() const {
        if (slice.run_ticks != 0 && last() > slice.run_ticks)
            input.fail(
                0,
                fmt::format(
                    "a slice that holds tick {} of a run of {} ticks", last(), slice.run_ticks));
    }

    [[noreturn]] void fail_attachment(const std::string& name, const std::string& fault) {
        input.fail(find_attachment(index, name)->offset,
                   fmt::format("the attachment '{}' is damaged ({})", name, fault));
    }

    /// Chunks hold ticks 1, 2, ... in order.
    void find_ranges() {
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

    std::optional<TickRange> range_of(const mcap::Chunk& chunk) const {
        const TickRange range{chunk.start_time / step_ns(), chunk.end_time / step_ns()};
        // One message a tick bounds the count: it sizes a table when the chunk is read.
        const std::uint64_t most =
            chunk.uncompressed_size / (mcap::prefix_size + mcap::message_header);
        if (chunk.start_time % step_ns() != 0 || chunk.end_time % step_ns() != 0 ||
            range.first != last() + 1 || range.last < range.first ||
            range.last - range.first >= most)
            return std::nullopt;
        return range;
    }

    /// Keeps the chunks up to the first that is not sound.
    void drop_broken_end() {
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

    /// How the run ended, when that was written and all its ticks are there.
    void salvage_outcome() {
        try {
            read_outcome();
        } catch (const world::Error&) {
            index.whole = false;
            if (loss.empty())
                loss = fmt::format("byte {}: the file ends behind tick {}", index.data_end, last());
            outcome = {"error", "the trace was cut off", ticks()};
        }
    }

    std::string cut_off() const {
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

    void read_outcome() {
        const auto facts = read_metadata(input, index, format::outcome_metadata);
        if (!facts)
            input.fail(0, "the trace does not say how the run ended ('reprise.outcome')");
        const auto text = [&](const char* key) {
            const auto found = facts->find(key);
            return found == facts->end() ? std::string() : found->second;
        };
        outcome = {text("verdict"), text("reason"), to_number(text("ticks"))};
        if (outcome.ticks != ticks())
            input.fail(index.data_end,
                       fmt::format("the index is damaged: it lists {} ticks, the run had {}",
                                   ticks(),
                                   outcome.ticks));
    }

    std::size_t chunk_of(std::uint64_t tick) const {
        REPRISE_CHECK(tick >= slice.first && tick <= last(),
                      fmt::format("tick {} of a trace with {} to {}", tick, slice.first, last()));
        const auto after = std::upper_bound(
            ranges.begin(), ranges.end(), tick, [](std::uint64_t wanted, const TickRange& range) {
                return wanted < range.first;
            });
        return static_cast<std::size_t>(after - ranges.begin()) - 1;
    }

    void load(std::uint64_t tick) {
        const std::size_t i = chunk_of(tick);
        if (ranges[i].first == loaded)
            return;
        loaded = none_loaded;  // should reading throw
        loaded_chunk.load(input, index.chunks[i], ranges[i], step_ns(), level);
        loaded = ranges[i].first;
    }

    std::string describe_damage(std::uint64_t tick) const {
        const std::size_t i = chunk_of(tick);
        return fmt::format("the chunk of ticks {} to {} is damaged ({})",
                           ranges[i].first,
                           ranges[i].last,
                           *loaded_chunk.damage());
    }

    /// The tick's bytes, or what is wrong with them. The chunk must be loaded.
    std::optional<std::string> take(std::uint64_t tick, RecordedTick& out) {
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

    void read_town() {
        AlignedCopy copy;
        const mcap::View town =
            copy.of(read_packed_attachment(input, index, format::town_attachment));
        if (const auto fault = fault_of_town(town))
            fail_attachment(format::town_attachment, *fault);
        world::GetTown(town.data())->UnPackTo(&recording.town);
        recording.recorded_town.assign(town.begin(), town.end());
        const mcap::Bytes network =
            read_packed_attachment(input, index, format::network_attachment);
        recording.network.assign(network.begin(), network.end());
        has_town = true;
    }
};

TraceReader::TraceReader(const std::filesystem::path& path)
    : file_(std::make_unique<File>(path, false)) {}

TraceReader::TraceReader(std::unique_ptr<File> file) : file_(std::move(file)) {}

TraceReader TraceReader::salvage(const std::filesystem::path& path) {
    return TraceReader(std::make_unique<File>(path, true));
}

const std::string& TraceReader::loss() const {
    return file_->loss;
}

TraceReader::~TraceReader() = default;
TraceReader::TraceReader(TraceReader&&) noexcept = default;
TraceReader& TraceReader::operator=(TraceReader&&) noexcept = default;

const std::filesystem::path& TraceReader::path() const {
    return file_->input.path();
}

std::uint64_t TraceReader::ticks() const {
    return file_->ticks();
}

Level TraceReader::level() const {
    return file_->level;
}

std::uint64_t TraceReader::first() const {
    return file_->slice.first;
}

std::uint64_t TraceReader::last() const {
    return file_->last();
}

std::uint64_t TraceReader::run_ticks() const {
    return file_->slice.run_ticks > 0 ? file_->slice.run_ticks : ticks();
}

std::optional<SliceStart> TraceReader::slice() const {
    if (file_->slice.run_ticks == 0)
        return std::nullopt;
    return file_->slice;
}

RecordedTick TraceReader::tick(std::uint64_t index) {
    if (!holds_traffic(file_->level, index))
        throw world::Error(lacks_text(path().string(), file_->level));
    return recorded(index);
}

RecordedTick TraceReader::recorded(std::uint64_t index) {
    file_->load(index);
    const std::uint64_t offset = file_->index.chunks[file_->chunk_of(index)].offset;
    if (file_->loaded_chunk.damage())
        file_->input.fail(offset,
                          file_->describe_damage(index) +
                              "; `reprise verify` names the first tick that is wrong, `reprise "
                              "recover` keeps those before");
    RecordedTick tick;
    if (const auto fault = file_->take(index, tick))
        file_->input.fail(offset, fmt::format("tick {} is damaged ({})", index, *fault));
    return tick;
}

world::Digest128 TraceReader::chain(std::uint64_t index) {
    if (index == 0)
        return file_->first_chain;
    if (index + 1 == first())
        return file_->slice.chain_before;
    return recorded(index).view.tick->digests()->chain();
}

const world::EpisodeT& TraceReader::episode() const {
    return file_->recording.episode;
}

const Outcome& TraceReader::outcome() const {
    return file_->outcome;
}

const Recording& TraceReader::recording() {
    if (!file_->has_town)
        file_->read_town();
    return file_->recording;
}

std::uint64_t TraceReader::file_size() const {
    return file_->input.size();
}

std::uint64_t TraceReader::packed_bytes() const {
    std::uint64_t bytes = 0;
    for (const mcap::Chunk& chunk : file_->index.chunks)
        bytes += chunk.length;
    return bytes;
}

std::uint64_t TraceReader::message_bytes() const {
    std::uint64_t bytes = 0;
    for (const mcap::Chunk& chunk : file_->index.chunks)
        bytes += chunk.uncompressed_size;
    const std::uint64_t messages =
        ticks() + traffic_ticks(file_->level, last()) - traffic_ticks(file_->level, first() - 1);
    return bytes - messages * (mcap::prefix_size + mcap::message_header);
}

std::optional<std::string> TraceReader::damage(std::uint64_t index) {
    file_->load(index);
    if (!file_->loaded_chunk.damage())
        return std::nullopt;
    return file_->describe_damage(index);
}

std::optional<RecordedTick> TraceReader::salvaged(std::uint64_t index) {
    file_->load(index);
    RecordedTick tick;
    if (file_->take(index, tick))
        return std::nullopt;
    return tick;
}

std::optional<std::string> TraceReader::damage() const {
    const TraceIndex& index = file_->index;
    if (!index.whole)
        return fmt::format("byte {}: {}", index.data_end, file_->cut_off());
    std::uint32_t crc = 0;
    mcap::Bytes block(std::min<std::uint64_t>(index.data_end, 1 << 20));
    for (std::uint64_t at = 0; at < index.data_end; at += block.size()) {
        const auto part =
            std::span(block).first(std::min<std::uint64_t>(block.size(), index.data_end - at));
        file_->input.read(at, part);
        crc = mcap::crc32(part, crc);
    }
    const mcap::Bytes end = file_->input.read(index.data_end, mcap::data_end_size);
    mcap::Decoder record(mcap::View(end).subspan(mcap::prefix_size));
    if (record.number<std::uint32_t>() == crc)
        return std::nullopt;
    return "the file was changed after it was recorded (checksum of the data section)";
}

PackedTicks TraceReader::packed(std::uint64_t index) {
    const std::size_t i = file_->chunk_of(index);
    const mcap::Chunk& chunk = file_->index.chunks[i];
    file_->packed.resize(chunk.length);
    file_->input.read(chunk.offset, file_->packed);
    return {file_->ranges[i].first, file_->ranges[i].last, file_->packed};
}

}  // namespace reprise::replay

#include "replay/trace_reader.h"

#include <algorithm>

#include <fmt/format.h>

#include "replay/level.h"
#include "replay/opened_trace.h"
#include "replay/written_again.h"
#include "world/check.h"

namespace reprise::replay {

TraceReader::TraceReader(const std::filesystem::path& path)
    : file_(std::make_unique<OpenedTrace>(path, false)) {}

TraceReader::TraceReader(std::unique_ptr<OpenedTrace> file) : file_(std::move(file)) {}

TraceReader TraceReader::salvage(const std::filesystem::path& path) {
    return TraceReader(std::make_unique<OpenedTrace>(path, true));
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

std::optional<world::SliceStart> TraceReader::slice() const {
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

const world::Outcome& TraceReader::outcome() const {
    return file_->outcome;
}

const world::Recording& TraceReader::recording() {
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

std::optional<std::string> TraceReader::damage() {
    const TraceIndex& index = file_->index;
    if (!index.whole)
        return fmt::format("byte {}: {}", index.data_end, file_->cut_off());
    recording();
    return difference_from_written(*file_, chain(last()));
}

PackedTicks TraceReader::packed(std::uint64_t index) {
    const std::size_t i = file_->chunk_of(index);
    const mcap::Chunk& chunk = file_->index.chunks[i];
    file_->packed.resize(chunk.length + chunk.message_index_length);
    file_->input.read(chunk.offset, file_->packed);
    return {file_->ranges[i].first, file_->ranges[i].last, file_->packed};
}

}  // namespace reprise::replay

#include "replay/trace_writer.h"

#include <fmt/format.h>

#include "replay/chain_seed.h"
#include "replay/chunk_thread.h"
#include "replay/level.h"
#include "replay/trace_facts.h"
#include "replay/trace_file.h"
#include "replay/trace_format.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::replay {

struct TraceWriter::File {
    Level level;
    Unfinished unfinished;
    TraceFile file;
    Reduction reduction;
    std::uint64_t step_ns;
    std::uint64_t first = 1;
    std::uint64_t run_ticks = 0;  ///< of a slice: that the whole run had
    std::uint64_t ticks = 0;
    world::Digest128 chain;  ///< of the last tick
    mcap::Bytes packed_episode;
    bool closed = false;
    std::unique_ptr<PendingChunk> chunk = std::make_unique<PendingChunk>();
    std::unique_ptr<ChunkThread> thread;

    File(const std::filesystem::path& path,
         const world::Recording& recording,
         Level its_level,
         Unfinished what_to_do,
         const std::optional<world::SliceStart>& slice)
        : level(its_level),
          unfinished(what_to_do),
          file(path, its_level, what_to_do),
          reduction(its_level),
          step_ns(recording.episode.step_ns),
          first(slice ? slice->first : 1),
          run_ticks(slice ? slice->run_ticks : 0),
          chain(chain_seed(recording)) {
        try {
            write_start(recording, slice);
        } catch (...) {
            file.abandon();
            throw;
        }
        thread = std::make_unique<ChunkThread>(file);
    }

    void write_start(const world::Recording& recording,
                     const std::optional<world::SliceStart>& slice) {
        const world::EpisodeT& episode = recording.episode;
        packed_episode = format::pack(episode);
        file.metadata(format::run_metadata, run_facts(episode, chain, level, slice));
        if (slice)
            chain = slice->chain_before;
        write_attachments(file, recording, packed_episode);
    }

    bool lacks_end() const { return run_ticks > 0 && first + ticks - 1 < run_ticks; }

    void give_up() noexcept {
        if (unfinished == Unfinished::keep)
            file.abandon();
        else
            file.discard();
    }

    /// Passes an error on with what became of the ticks; no more can be written after it.
    template <typename Action>
    void guarded(Action action) {
        try {
            action();
        } catch (const world::Error& error) {
            thread.reset();  // the file is ours again
            give_up();
            closed = true;
            throw world::Error(file.has_chunks() && unfinished == Unfinished::keep
                                   ? fmt::format("{}; what was recorded until then is in {}",
                                                 error.what(),
                                                 file.partial().string())
                                   : std::string(error.what()));
        }
    }
};

TraceWriter::TraceWriter(const std::filesystem::path& path,
                         const world::Recording& recording,
                         Level level,
                         Unfinished unfinished,
                         const std::optional<world::SliceStart>& slice) {
    REPRISE_CHECK(recording.episode.step_ns > 0, "an episode needs a step");
    REPRISE_CHECK(!slice || (slice->first > 0 && slice->first <= slice->run_ticks),
                  "a slice needs a start");
    REPRISE_CHECK(!slice || slice->first == 1 || level != Level::inputs,
                  "inputs are simulated from tick 1");
    file_ = std::make_unique<File>(path, recording, level, unfinished, slice);
}

TraceWriter::~TraceWriter() {
    if (file_->closed)
        return;
    // The run stopped early: what it did so far is worth keeping, but must not look whole.
    try {
        if (!file_->chunk->messages.empty())
            file_->thread->exchange(file_->chunk);
        file_->thread->finish();
    } catch (...) {
        // The disk may be full. The chunks that were written stay, as PATH.partial.
    }
    file_->thread.reset();
    file_->give_up();
}

void TraceWriter::append(const world::SealedTick& tick) {
    append(RecordedTick{tick.view(), tick.tick_bytes(), tick.traffic_bytes()});
}

void TraceWriter::append(const RecordedTick& tick) {
    const std::uint64_t index = tick.view.index();
    REPRISE_CHECK(!file_->closed, fmt::format("tick {} after the end", index));
    REPRISE_CHECK(index == file_->first + file_->ticks,
                  fmt::format("tick {} as number {} from {}", index, file_->ticks, file_->first));
    file_->guarded([&] {
        file_->thread->check();
        const std::uint64_t log_time = index * file_->step_ns;
        const RecordedTick kept = file_->reduction.of(tick);
        file_->chunk->add(format::tick_channel, index, log_time, kept.tick_bytes);
        if (!kept.traffic_bytes.empty())
            file_->chunk->add(format::traffic_channel, index, log_time, kept.traffic_bytes);
        file_->chain = tick.view.tick->digests()->chain();
        ++file_->ticks;
        if (index % format::ticks_per_chunk == 0)
            file_->thread->exchange(file_->chunk);
    });
}

void TraceWriter::close(const world::Outcome& outcome) {
    REPRISE_CHECK(!file_->closed, "the trace is closed already");
    file_->guarded([&] {
        if (!file_->chunk->messages.empty())
            file_->thread->exchange(file_->chunk);
        file_->thread->finish();
        file_->file.metadata(
            format::outcome_metadata,
            outcome_facts(file_->lacks_end()
                              ? world::outcome_of_part(file_->ticks)
                              : world::Outcome{outcome.verdict, outcome.reason, file_->ticks},
                          file_->chain,
                          file_->packed_episode));
        file_->file.finish();
    });
    file_->closed = true;
}

}  // namespace reprise::replay

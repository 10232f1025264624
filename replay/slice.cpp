#include "replay/slice.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "replay/chain_seed.h"
#include "replay/level.h"
#include "replay/trace_facts.h"
#include "replay/trace_writer.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::replay {

namespace {

/// How those were spawned who are there before a tick, in [first(), last() + 1]. Reads all ticks
/// before it.
world::Spawns spawns_before(TraceReader& trace, std::uint64_t index) {
    const auto slice = trace.slice();
    world::Spawns spawns = slice ? slice->spawns : world::Spawns();
    for (std::uint64_t earlier = trace.first(); earlier < index; ++earlier)
        world::hear_spawns(*trace.recorded(earlier).view.tick, spawns);
    return spawns;
}

world::SliceStart start_at(TraceReader& trace, std::uint64_t first) {
    return {first, trace.run_ticks(), trace.chain(first - 1), spawns_before(trace, first)};
}

/// Every link of the chain is checked on the way: what is cut and joined is what was recorded.
void copy(TraceReader& trace, std::uint64_t first, std::uint64_t last, TraceWriter& writer) {
    world::Digest128 chain = trace.chain(first - 1);
    for (std::uint64_t index = first; index <= last; ++index) {
        const RecordedTick tick = trace.recorded(index);
        const world::Digests& digests = *tick.view.tick->digests();
        chain = world::chain(chain_before(trace.episode(), index, chain), digests.state());
        if (!(chain == digests.chain()))
            throw world::Error(fmt::format(
                "{}: tick {} does not continue the digest chain", trace.path().string(), index));
        writer.append(tick);
    }
}

/// Writes with `fill`, at the trace's level; a mistake found on the way leaves nothing behind.
template <typename Fill>
void write(const std::filesystem::path& out,
           TraceReader& of,
           const world::SliceStart& start,
           std::uint64_t last,
           const world::Outcome& outcome,
           Fill fill) {
    const bool whole = start.first == 1 && last == start.run_ticks;
    TraceWriter writer(out,
                       of.recording(),
                       of.level(),
                       Unfinished::remove,
                       whole ? std::nullopt : std::optional(start));
    fill(writer);
    writer.close(outcome);
}

std::string joined(const TraceReader& trace) {
    return fmt::format("{} (ticks {} to {})", trace.path().string(), trace.first(), trace.last());
}

/// "tick 51 is" or "ticks 51 to 60 are".
std::string ticks_are(std::uint64_t first, std::uint64_t last) {
    return first == last ? fmt::format("tick {} is", first)
                         : fmt::format("ticks {} to {} are", first, last);
}

/// Throws unless the later one goes on, in the same run, where the earlier one ends.
void require_seam(TraceReader& earlier, TraceReader& later) {
    const auto refuse = [&](const std::string& why) {
        throw world::Error(
            fmt::format("cannot join {} and {}: {}", joined(earlier), joined(later), why));
    };
    if (!(earlier.chain(0) == later.chain(0)))
        refuse("they are of different runs (seed, scenario, town or settings differ)");
    if (earlier.run_ticks() != later.run_ticks())
        refuse("they are of different runs (one ended earlier)");
    if (earlier.level() != later.level())
        refuse(fmt::format("they are of the levels {} and {}; `reprise strip` gives both the lower",
                           to_word(earlier.level()),
                           to_word(later.level())));
    if (later.first() > earlier.last() + 1)
        refuse(ticks_are(earlier.last() + 1, later.first() - 1) + " missing between them");
    if (later.first() <= earlier.last())
        refuse(ticks_are(later.first(), std::min(earlier.last(), later.last())) + " in both");
    if (!(later.chain(later.first() - 1) == earlier.chain(earlier.last())))
        refuse("the second continues another history (its digest chain differs)");
    Facts there;
    Facts told;
    add_spawns(spawns_before(earlier, earlier.last() + 1), there);
    add_spawns(later.slice() ? later.slice()->spawns : world::Spawns(), told);
    if (there != told)
        refuse("the second says otherwise who is there (its metadata was changed)");
}

}  // namespace

void slice(TraceReader& trace,
           std::uint64_t first,
           std::uint64_t last,
           const std::filesystem::path& out) {
    if (trace.level() == Level::inputs && first > 1)
        throw world::Error(fmt::format(
            "{}: of inputs only a slice from tick 1 on can be simulated again, not one from {}; {}",
            trace.path().string(),
            first,
            lacks_text(trace.path().string(), trace.level())));
    write(out, trace, start_at(trace, first), last, trace.outcome(), [&](TraceWriter& writer) {
        copy(trace, first, last, writer);
    });
}

void merge(std::vector<TraceReader>& parts, const std::filesystem::path& out) {
    REPRISE_CHECK(parts.size() >= 2, fmt::format("a merge of {} traces", parts.size()));
    std::ranges::stable_sort(parts, {}, &TraceReader::first);
    for (std::size_t i = 1; i < parts.size(); ++i)
        require_seam(parts[i - 1], parts[i]);
    TraceReader& start = parts.front();
    TraceReader& end = parts.back();  // the only one that may know how the run ended
    const world::SliceStart from = start_at(start, start.first());
    write(out, start, from, end.last(), end.outcome(), [&](TraceWriter& writer) {
        for (TraceReader& part : parts)
            copy(part, part.first(), part.last(), writer);
    });
}

void require_start_of_run(const TraceReader& trace) {
    if (trace.first() > 1)
        throw world::Error(fmt::format(
            "{}: a slice that begins at tick {}; a run can only be simulated and compared from its "
            "start: use the whole trace, or reprise merge",
            trace.path().string(),
            trace.first()));
}

}  // namespace reprise::replay

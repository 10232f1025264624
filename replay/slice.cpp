#include "replay/slice.h"

#include <fmt/format.h>
#include <optional>

#include "replay/level.h"
#include "replay/trace_writer.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::replay {

namespace {

SliceStart start_at(TraceReader& trace, std::uint64_t first) {
    return {first, trace.run_ticks(), trace.chain(first - 1)};
}

/// Every link of the chain is checked on the way: what is cut and joined is what was recorded.
void copy(TraceReader& trace, std::uint64_t first, std::uint64_t last, TraceWriter& writer) {
    world::Digest128 chain = trace.chain(first - 1);
    for (std::uint64_t index = first; index <= last; ++index) {
        const RecordedTick tick = trace.recorded(index);
        const world::Digests& digests = *tick.view.tick->digests();
        chain = world::chain(chain, digests.state());
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
           const SliceStart& start,
           std::uint64_t last,
           Fill fill) {
    const bool whole = start.first == 1 && last == start.run_ticks;
    TraceWriter writer(out,
                       of.recording(),
                       of.level(),
                       Unfinished::remove,
                       whole ? std::nullopt : std::optional(start));
    fill(writer);
    writer.close(of.outcome());
}

std::string joined(const TraceReader& trace) {
    return fmt::format("{} (ticks {} to {})", trace.path().string(), trace.first(), trace.last());
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
    write(out, trace, start_at(trace, first), last, [&](TraceWriter& writer) {
        copy(trace, first, last, writer);
    });
}

void merge(TraceReader& earlier, TraceReader& later, const std::filesystem::path& out) {
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
    if (later.first() != earlier.last() + 1)
        refuse(fmt::format("the second would have to begin at tick {}", earlier.last() + 1));
    if (!(later.chain(later.first() - 1) == earlier.chain(earlier.last())))
        refuse("the second continues another history (its digest chain differs)");
    write(out, earlier, start_at(earlier, earlier.first()), later.last(), [&](TraceWriter& writer) {
        copy(earlier, earlier.first(), earlier.last(), writer);
        copy(later, later.first(), later.last(), writer);
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

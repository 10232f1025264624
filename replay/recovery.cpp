#include "replay/recovery.h"

#include <optional>

#include <fmt/format.h>

#include "files/ending.h"
#include "files/output_place.h"
#include "replay/chain_seed.h"
#include "replay/mcap/files.h"
#include "replay/outcomes.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::replay {

namespace {

namespace fs = std::filesystem;

/// The last tick up to which all links of the chain hold, and what is wrong with the next one.
/// Checksums tell what the disk did; the chain also tells of bytes from another recording.
struct Links {
    std::uint64_t sound = 0;
    std::string loss;
};

Links follow_chain(TraceReader& trace) {
    Links links;
    world::Digest128 chain = trace.chain(0);
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
        try {
            const world::Digests& digests = *trace.recorded(index).view.tick->digests();
            chain = world::chain(chain_before(trace.episode(), index, chain), digests.state());
            if (!(chain == digests.chain())) {
                links.loss = fmt::format("tick {} does not continue the digest chain", index);
                break;
            }
        } catch (const world::Error& error) {
            links.loss = error.what();
            break;
        }
        links.sound = index;
    }
    return links;
}

/// OUT must be another plain file, and its folder must be there: told before anything is read.
/// Returns it, behind its links.
fs::path check_paths(const fs::path& damaged, const fs::path& out) {
    const InputFile readable(damaged);
    std::error_code ignored;
    if (fs::equivalent(damaged, out, ignored))
        throw world::Error(fmt::format(
            "{}: this is the damaged trace itself; name another file for what is recovered",
            out.string()));
    return files::output_target(out, "the trace");
}

TraceReader open(const fs::path& damaged) {
    try {
        TraceReader trace = TraceReader::salvage(damaged);
        if (trace.ticks() > 0) {
            if (trace.chain(0) == chain_seed(trace.recording()))
                return trace;
            throw world::Error(fmt::format(
                "{}: the episode, the town or the network in it was changed: the digest chain "
                "began with another",
                damaged.string()));
        }
    } catch (const world::Error& error) {
        throw NothingToRecover(error.what());
    }
    throw NothingToRecover(
        fmt::format("{}: no whole chunk of ticks is left in it", damaged.string()));
}

/// Writes the trace, or nothing.
void write_recovered(const fs::path& path, TraceReader& trace, const world::Outcome& outcome) {
    TraceWriter writer(path, trace.recording(), trace.level(), Unfinished::remove, trace.slice());
    for (std::uint64_t index = 1; index <= outcome.ticks; ++index)
        writer.append(trace.recorded(index));
    writer.close(outcome);
}

}  // namespace

Recovery recover(const fs::path& damaged, const fs::path& out) {
    const fs::path target = check_paths(damaged, out);
    TraceReader trace = open(damaged);
    if (trace.first() > 1)
        throw world::Error(fmt::format(
            "{}: a slice that begins at tick {}; cut it again from the whole trace instead",
            damaged.string(),
            trace.first()));
    Recovery recovery{trace.episode(), trace.outcome(), trace.loss()};
    const Links links = follow_chain(trace);
    if (links.sound == 0)
        throw NothingToRecover(fmt::format("{}: {}", damaged.string(), links.loss));
    if (links.sound < trace.ticks()) {
        recovery.loss = links.loss + (recovery.loss.empty() ? "" : "; " + recovery.loss);
        recovery.outcome = world::outcome_of_cut_off(links.sound);
    } else if (recovery.outcome == world::outcome_of_cut_off(links.sound)) {
        // Only the end of the file is lost: the ticks tell how the run ended.
        recovery.outcome = told_outcome(trace).value_or(recovery.outcome);
    }
    // Not OUT.partial: that may be what is recovered.
    const fs::path grown = target.string() + ".recovered";
    const files::RemovedWhenEnded note(grown);
    write_recovered(grown, trace, recovery.outcome);
    std::error_code error;
    fs::rename(grown, target, error);
    if (error) {
        std::error_code ignored;
        fs::remove(grown, ignored);
        throw world::Error(
            fmt::format("{}: cannot write the trace: {}", out.string(), error.message()));
    }
    return recovery;
}

}  // namespace reprise::replay

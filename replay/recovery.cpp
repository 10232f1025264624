#include "replay/recovery.h"

#include <fmt/format.h>
#include <optional>

#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::replay {

namespace {

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
            const world::Digests& digests = *trace.tick(index).view.tick->digests();
            chain = world::chain(chain, digests.state());
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

}  // namespace

Recovery recover(const std::filesystem::path& damaged, const std::filesystem::path& out) {
    TraceReader trace = TraceReader::salvage(damaged);
    if (trace.ticks() == 0)
        throw world::Error(fmt::format("{}: nothing to recover: no whole chunk of ticks is left",
                                       damaged.string()));
    Recovery recovery{trace.outcome(), trace.loss()};
    const Links links = follow_chain(trace);
    if (links.sound < trace.ticks()) {
        if (links.sound == 0)
            throw world::Error(
                fmt::format("{}: nothing to recover: {}", damaged.string(), links.loss));
        recovery.loss = links.loss + (recovery.loss.empty() ? "" : "; " + recovery.loss);
        recovery.outcome = {"error", "the trace was cut off", links.sound};
    }
    TraceWriter writer(out, trace.recording());
    for (std::uint64_t index = 1; index <= links.sound; ++index)
        writer.append(trace.tick(index));
    writer.close(recovery.outcome);
    return recovery;
}

}  // namespace reprise::replay

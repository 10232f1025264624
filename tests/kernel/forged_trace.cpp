#include "tests/kernel/forged_trace.h"

#include <algorithm>

#include "kernel/kernel.h"
#include "kernel/verify.h"
#include "replay/compare/divergence.h"
#include "replay/slice.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "tests/kernel/whole_run.h"
#include "tests/replay/forgery.h"
#include "towns/network/network.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::test {
namespace {

/// Six ticks at a crossing, with a car of each kind and a check.
world::Recording at_a_crossing() {
    static const towns::Network network =
        towns::load_network(std::string(REPRISE_SOURCE) + "/tests/cli/crash/small.net.xml");
    world::Recording recording = in_town1(R"(
        local ego = spawn{ name = 'ego', model = 'sedan' }
        local hand = spawn{ name = 'hand', model = 'van', driver = 'manual' }
        check.never('late', function() return tick() >= 4 end)
        wait(60))",
                                          3,
                                          0.3);
    recording.town = towns::read_town(network);
    recording.network = network.xml;
    recording.episode.town = network.name;
    recording.episode.town_path = "small.net.xml";
    recording.episode.town_digest = world::digest128(recording.network);
    recording.episode.parameters.push_back({});
    recording.episode.parameters.back().key = "gap";
    recording.episode.parameters.back().value = "1";
    recording.episode.fingerprint.push_back({});
    recording.episode.fingerprint.back().key = "compiler";
    recording.episode.fingerprint.back().value = "gcc 12";
    return recording;
}

std::string mcap_name(const FileRecord& record) {
    return "record " + std::to_string(static_cast<int>(record.op)) + " at " +
           std::to_string(record.from);
}

}  // namespace

using replay::TraceReader;
using replay::TraceWriter;
namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

ForgedTrace::ForgedTrace() : recording_(at_a_crossing()) {
    record(whole_, replay::Level::full);
}

void ForgedTrace::record(const std::filesystem::path& path,
                         replay::Level level,
                         const std::vector<world::BranchT>& branches) {
    world::Recording recording = recording_;
    recording.episode.branches = branches;
    TraceWriter trace(path, recording, level);
    kernel::Kernel kernel(recording);
    while (!kernel.finished())
        trace.append(kernel.step());
    trace.close(kernel.outcome());
}

std::string ForgedTrace::verified(const std::filesystem::path& path) {
    try {
        TraceReader trace(path);
        replay::require_start_of_run(trace);
        const auto divergence = kernel::verify(trace);
        return divergence ? to_text(*divergence, trace.episode().step_ns) : "";
    } catch (const world::Error& error) {
        return error.what();
    }
}

std::string ForgedTrace::compared(const std::filesystem::path& original,
                                  const std::filesystem::path& forged) {
    try {
        TraceReader expected(original);
        TraceReader found(forged);
        const auto divergence = replay::compare(expected, found);
        return divergence ? to_text(*divergence, expected.episode().step_ns) : "";
    } catch (const world::Error& error) {
        return error.what();
    }
}

std::string ForgedTrace::read_through(const std::filesystem::path& path) {
    try {
        TraceReader trace(path);
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
            if (const auto damage = trace.damage(index))
                return *damage;
        return trace.damage().value_or("");
    } catch (const world::Error& error) {
        return error.what();
    }
}

void ForgedTrace::write(const world::Recording& recording,
                        const std::vector<TickBytes>& ticks,
                        const world::Outcome& outcome) {
    TraceWriter writer(forged_, recording);
    for (const TickBytes& tick : ticks)
        writer.append({{world::GetTick(tick.tick.data()), world::GetTraffic(tick.traffic.data())},
                       tick.tick,
                       tick.traffic});
    writer.close(outcome);
}

std::vector<TickBytes> ForgedTrace::recorded_ticks() {
    std::vector<TickBytes> ticks;
    TraceReader trace(whole_);
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
        ticks.push_back(bytes_of(trace.tick(index)));
    return ticks;
}

void ForgedTrace::flip_bytes(const std::filesystem::path& original, std::size_t of_each_record) {
    ASSERT_EQ(verified(original), "");
    const Bytes whole = read_file(original);
    std::size_t changes = 0;
    for (const FileRecord& record : records_of(whole)) {
        const std::size_t stride = std::max<std::size_t>(1, record.size / of_each_record);
        for (std::size_t at = record.from; at < record.from + record.size; at += stride) {
            Bytes bytes = whole;
            bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ 1);
            repair_checksums(bytes);
            if (bytes == whole)
                continue;  // it was a byte of a checksum
            write_file(forged_, bytes);
            constexpr std::size_t fully = 40;  // one in so many is simulated in any case
            std::string told = ++changes % fully == 0 ? "" : read_through(forged_);
            if (told.empty())
                told = verified(forged_);
            // Packed otherwise, and the same when unpacked: another libzstd does that, too.
            if (told.empty() && unpacked_parts(bytes) == unpacked_parts(whole) &&
                (record.op == mcap::Op::chunk || record.op == mcap::Op::attachment))
                continue;
            EXPECT_NE(told, "") << mcap_name(record) << " byte " << at - record.from;
            EXPECT_NE(compared(original, forged_), "")
                << mcap_name(record) << " byte " << at - record.from;
        }
    }
}

}  // namespace reprise::test

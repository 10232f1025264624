// Nothing in a trace may be changed with its checksums repaired and be called equal. Three ways to
// change one: any byte of the file; any value of what it holds, written anew throughout; and
// records that no run writes.
#include <array>
#include <filesystem>

#include <gmock/gmock.h>

#include "kernel/verify.h"
#include "replay/chain_seed.h"
#include "replay/noun_check.h"
#include "replay/outcomes.h"
#include "replay/recovery.h"
#include "replay/slice.h"
#include "replay/trace_facts.h"
#include "replay/trace_file.h"
#include "replay/trace_writer.h"
#include "tests/kernel/whole_run.h"
#include "tests/replay/forgery.h"
#include "tests/replay/synthetic_run.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::test {
namespace {

using replay::TraceReader;
using replay::TraceWriter;
using testing::HasSubstr;
namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

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

class ForgedTrace : public testing::Test {
  protected:
    ForgedTrace() { record(whole_, replay::Level::full); }

    void record(const std::filesystem::path& path,
                replay::Level level,
                const std::vector<world::BranchT>& branches = {}) {
        world::Recording recording = recording_;
        recording.episode.branches = branches;
        TraceWriter trace(path, recording, level);
        kernel::Kernel kernel(recording);
        while (!kernel.finished())
            trace.append(kernel.step());
        trace.close(kernel.outcome());
    }

    /// What verify makes of it: the difference or the refusal; "" when it calls it equal.
    static std::string verified(const std::filesystem::path& path) {
        try {
            TraceReader trace(path);
            replay::require_start_of_run(trace);
            const auto divergence = kernel::verify(trace);
            return divergence ? to_text(*divergence, trace.episode().step_ns) : "";
        } catch (const world::Error& error) {
            return error.what();
        }
    }

    /// The same of diff against the original.
    static std::string compared(const std::filesystem::path& original,
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

    /// What verify would find without simulating: it refuses to open the file, or looks at its
    /// bytes. Most forgeries fail there, and a run for each takes long.
    static std::string read_through(const std::filesystem::path& path) {
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

    /// Writes a trace anew from these parts, as the program itself would: all copies of a value
    /// agree, and all checksums.
    void write(const world::Recording& recording,
               const std::vector<TickBytes>& ticks,
               const world::Outcome& outcome) {
        TraceWriter writer(forged_, recording);
        for (const TickBytes& tick : ticks)
            writer.append(
                {{world::GetTick(tick.tick.data()), world::GetTraffic(tick.traffic.data())},
                 tick.tick,
                 tick.traffic});
        writer.close(outcome);
    }

    std::vector<TickBytes> recorded_ticks() {
        std::vector<TickBytes> ticks;
        TraceReader trace(whole_);
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
            ticks.push_back(bytes_of(trace.tick(index)));
        return ticks;
    }

    /// Changes a byte in about so many places of every record, and demands that it is said.
    void flip_bytes(const std::filesystem::path& original, std::size_t of_each_record) {
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

    static std::string mcap_name(const FileRecord& record) {
        return "record " + std::to_string(static_cast<int>(record.op)) + " at " +
               std::to_string(record.from);
    }

    const world::Recording recording_ = at_a_crossing();
    Folder folder_;
    std::filesystem::path whole_ = folder_ / "whole.mcap";
    std::filesystem::path forged_ = folder_ / "forged.mcap";
};

TEST_F(ForgedTrace, IsToldWhicheverByteWasChanged) {
    flip_bytes(whole_, 60);
}

TEST_F(ForgedTrace, IsToldAtEveryLevel) {
    for (const replay::Level level :
         {replay::Level::inputs, replay::Level::core, replay::Level::keyed}) {
        const auto path = folder_ / "level.mcap";
        record(path, level);
        flip_bytes(path, 12);
    }
}

TEST_F(ForgedTrace, IsToldOfABranchAndOfASlice) {
    world::BranchT branch;
    branch.tick = 3;
    branch.name = "test";
    branch.scenario_path = "test.lua";
    branch.max_ticks = 6;
    branch.parameters.push_back({});
    branch.parameters.back().key = "gap";
    branch.parameters.back().value = "2";
    const auto branched = folder_ / "branched.mcap";
    record(branched, replay::Level::full, {branch});
    flip_bytes(branched, 12);
    const auto part = folder_ / "part.mcap";
    TraceReader trace(whole_);
    slice(trace, 1, 4, part);
    flip_bytes(part, 12);
}

TEST_F(ForgedTrace, IsToldOfAMergedAndOfARecoveredTrace) {
    const auto merged = folder_ / "merged.mcap";
    {
        TraceReader trace(whole_);
        slice(trace, 1, 3, folder_ / "1.mcap");
        slice(trace, 4, 6, folder_ / "2.mcap");
        std::vector<TraceReader> parts;
        parts.emplace_back(folder_ / "1.mcap");
        parts.emplace_back(folder_ / "2.mcap");
        merge(parts, merged);
    }
    flip_bytes(merged, 12);
    Bytes bytes = read_file(whole_);
    bytes.resize(bytes.size() - mcap::tail_size);
    write_file(folder_ / "cut.mcap", bytes);
    const auto recovered = folder_ / "recovered.mcap";
    replay::recover(folder_ / "cut.mcap", recovered);
    flip_bytes(recovered, 12);
}

/// Every value of the episode, changed in all places where it is, with the ticks as they were. Only
/// where the town's file lay and who recorded it are not in the chain.
TEST_F(ForgedTrace, IsToldWhicheverValueOfTheEpisodeWasChangedThroughout) {
    const std::vector<TickBytes> ticks = recorded_ticks();
    const world::Outcome outcome = TraceReader(whole_).outcome();
    const Bytes packed = replay::format::pack(recording_.episode);
    const auto labels_cut = [](world::EpisodeT episode) {
        episode.town_path.clear();
        episode.fingerprint.clear();
        return replay::format::pack(episode);
    };
    int values = 0;
    int labels = 0;
    for (std::size_t at = 0; at < packed.size(); ++at) {
        alignas(8) std::array<std::uint8_t, 4096> bytes{};
        ASSERT_LE(packed.size(), bytes.size());
        std::copy(packed.begin(), packed.end(), bytes.begin());
        bytes[at] ^= 1;
        const mcap::View view(bytes.data(), packed.size());
        if (replay::fault_of_episode(view))
            continue;
        world::Recording changed = recording_;
        world::GetEpisode(view.data())->UnPackTo(&changed.episode);
        if (replay::format::pack(changed.episode) == packed || changed.episode.step_ns < 1000)
            continue;
        const bool label = labels_cut(changed.episode) == labels_cut(recording_.episode);
        (label ? labels : values) += 1;
        EXPECT_EQ(replay::chain_seed(changed) == replay::chain_seed(recording_), label) << at;
        if (label || values % 25 != 1)
            continue;  // a run for each takes long, and the chain's start decides
        if (changed.episode.step_ns != recording_.episode.step_ns)
            continue;  // other times: the writer's own
        write(changed, ticks, outcome);
        EXPECT_NE(verified(forged_), "") << at;
        EXPECT_NE(compared(whole_, forged_), "") << at;
    }
    EXPECT_GT(values, 300);
    EXPECT_GT(labels, 20);
}

TEST_F(ForgedTrace, IsToldWhicheverByteOfTheTownOrTheNetworkWasChangedThroughout) {
    const Bytes packed = replay::format::pack(recording_.town);
    const world::Digest128 seed = replay::chain_seed(recording_);
    int changes = 0;
    for (std::size_t at = 0; at < packed.size(); at += 41) {
        std::vector<std::uint64_t> aligned(packed.size() / 8 + 1);
        auto* bytes = reinterpret_cast<std::uint8_t*>(aligned.data());
        std::copy(packed.begin(), packed.end(), bytes);
        bytes[at] ^= 1;
        if (replay::fault_of_town({bytes, packed.size()}))
            continue;
        world::Recording changed = recording_;
        changed.town = {};
        world::GetTown(bytes)->UnPackTo(&changed.town);
        if (replay::format::pack(changed.town) == packed)
            continue;
        ++changes;
        EXPECT_NE(replay::chain_seed(changed), seed) << at;
    }
    EXPECT_GT(changes, 100);
    world::Recording changed = recording_;
    changed.network += "\n";
    changed.episode.town_digest = world::digest128(changed.network);
    write(changed, recorded_ticks(), TraceReader(whole_).outcome());
    EXPECT_THAT(verified(forged_), HasSubstr("digests.chain"));
}

TEST_F(ForgedTrace, IsToldWhicheverByteOfATickWasChanged) {
    const std::vector<TickBytes> ticks = recorded_ticks();
    const world::Outcome outcome = TraceReader(whole_).outcome();
    int changes = 0;
    for (const std::size_t index : {1u, 6u}) {
        for (const bool traffic : {false, true}) {
            const Bytes& original = traffic ? ticks[index - 1].traffic : ticks[index - 1].tick;
            for (std::size_t at = 0; at < original.size(); at += original.size() / 25 + 1) {
                std::vector<TickBytes> changed = ticks;
                TickBytes& tick = changed[index - 1];
                (traffic ? tick.traffic : tick.tick)[at] ^= 1;
                if (replay::fault_of_tick(tick.tick, index) ||
                    replay::fault_of_traffic(tick.traffic, index))
                    continue;  // no reader would give it
                ++changes;
                write(recording_, changed, outcome);
                EXPECT_NE(verified(forged_), "") << index << " " << at;
                EXPECT_NE(compared(whole_, forged_), "") << index << " " << at;
            }
        }
    }
    EXPECT_GT(changes, 40);
}

TEST_F(ForgedTrace, IsToldWhenItEndsOtherwise) {
    std::vector<TickBytes> ticks = recorded_ticks();
    const world::Outcome outcome = TraceReader(whole_).outcome();
    ASSERT_EQ(outcome.verdict, "failed");
    write(recording_, ticks, {"passed", outcome.reason, 6});
    EXPECT_EQ(verified(forged_),
              "tick 6 (0.30 s), stage end\n"
              "  field     outcome\n"
              "  expected  passed: time limit\n"
              "  found     failed: time limit\n"
              "  note      all ticks are equal\n");
    EXPECT_THAT(compared(whole_, forged_), HasSubstr("outcome.verdict"));
    write(recording_, ticks, {"failed", "arrived", 6});
    EXPECT_THAT(verified(forged_), HasSubstr("failed: arrived"));
    write(recording_, ticks, world::outcome_of_cut_off(6));
    EXPECT_THAT(verified(forged_), HasSubstr("error: the trace was cut off"));
    ticks.pop_back();
    write(recording_, ticks, {"failed", "time limit", 5});
    EXPECT_THAT(verified(forged_), HasSubstr("the run goes on"));
    write(recording_, ticks, world::outcome_of_cut_off(5));
    EXPECT_EQ(verified(forged_), "");  // and it says that it was cut off
    write(recording_, ticks, world::outcome_of_part(5));
    EXPECT_THAT(verified(forged_), HasSubstr("is a part, and nothing else is"));
}

TEST_F(ForgedTrace, IsToldOfABranchBehindItsEnd) {
    world::Recording changed = recording_;
    changed.episode.branches.push_back({});
    changed.episode.branches.back().tick = 6;
    changed.episode.branches.back().max_ticks = 100;
    write(changed, recorded_ticks(), TraceReader(whole_).outcome());
    EXPECT_THAT(verified(forged_), HasSubstr("a branch at tick 6"));
}

/// Records that no run writes, each with a right index and right checksums.
class ForeignRecord : public ForgedTrace {
  protected:
    template <typename Extra>
    void write_with(Extra extra) {
        TraceReader trace(whole_);
        replay::TraceFile file(forged_, replay::Level::full, files::Unfinished::remove);
        replay::PendingChunk chunk;
        file.metadata(
            replay::format::run_metadata,
            replay::run_facts(trace.episode(), trace.chain(0), replay::Level::full, std::nullopt));
        const Bytes episode = replay::format::pack(trace.episode());
        write_attachments(file, trace.recording(), episode);
        for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
            const replay::RecordedTick tick = trace.tick(index);
            const std::uint64_t time = index * trace.episode().step_ns;
            chunk.add(replay::format::tick_channel, index, time, tick.tick_bytes);
            chunk.add(replay::format::traffic_channel, index, time, tick.traffic_bytes);
        }
        extra(file, chunk);
        file.chunk(chunk);
        file.metadata(replay::format::outcome_metadata,
                      replay::outcome_facts(trace.outcome(), trace.chain(trace.last()), episode));
        file.finish();
    }

    void expect_told() {
        EXPECT_NE(verified(forged_), "");
        EXPECT_NE(compared(whole_, forged_), "");
    }
};

TEST_F(ForeignRecord, IsToldWhereverItLies) {
    write_with([](auto&, auto&) {});
    ASSERT_EQ(read_file(forged_), read_file(whole_));
    write_with([](auto& file, auto&) { file.metadata("author", {{"name", "me"}}); });
    expect_told();
    write_with([](auto& file, auto&) {
        file.metadata(replay::format::run_metadata, {{"seed", "99"}});
    });
    expect_told();
    write_with([](auto& file, auto&) { file.attachment("note.txt", "text/plain", Bytes{1, 2}); });
    expect_told();
    write_with([](auto&, auto& chunk) { chunk.add(2, 6, 300'000'000, Bytes{1, 2, 3}); });
    expect_told();
    write_with([](auto&, auto& chunk) {
        mcap::Encoder record(chunk.records);  // of no channel: a private record
        record.number(std::uint8_t{0x80});
        record.number(std::uint64_t{0});
    });
    expect_told();
}

TEST_F(ForeignRecord, IsToldWhenTheIndexDoesNotKnowIt) {
    Bytes record;
    mcap::Encoder encoder(record);
    encoder.number(std::uint8_t{0x80});
    encoder.number(std::uint64_t{3});
    encoder.raw(Bytes{1, 2, 3});
    for (const bool in_summary : {false, true}) {
        Bytes bytes = read_file(whole_);
        insert_record(bytes, record, in_summary);
        write_file(forged_, bytes);
        expect_told();
    }
    Bytes bytes = read_file(whole_);
    bytes.insert(bytes.end() - mcap::tail_size, record.begin(), record.end());
    repair_checksums(bytes);
    write_file(forged_, bytes);
    expect_told();
}

}  // namespace
}  // namespace reprise::test

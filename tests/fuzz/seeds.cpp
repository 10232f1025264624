#include "tests/fuzz/seeds.h"

#include <zstd.h>

#include "replay/mcap/mcap.h"
#include "replay/slice.h"
#include "tests/replay/synthetic_run.h"

namespace reprise::test {

namespace {

namespace fs = std::filesystem;
namespace mcap = replay::mcap;
using mcap::Bytes;
using mcap::View;

Bytes unpacked(View packed) {
    Bytes bytes(ZSTD_getFrameContentSize(packed.data(), packed.size()));
    ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
    return bytes;
}

/// A zstd frame of raw blocks: RFC 8878, 3.1.1.
Bytes raw_frame(View bytes) {
    constexpr std::size_t block = 100'000;  // 128 KiB at most
    Bytes frame;
    mcap::Encoder encoder(frame);
    encoder.number(std::uint32_t{0xFD2FB528});
    encoder.number(std::uint8_t{0xA0});  // one segment, its size in four bytes
    encoder.number(static_cast<std::uint32_t>(bytes.size()));
    for (std::size_t at = 0; at < bytes.size(); at += block) {
        const View part = bytes.subspan(at, std::min(block, bytes.size() - at));
        const bool last = at + block >= bytes.size();
        const auto header = static_cast<std::uint32_t>(part.size() << 3) | (last ? 1U : 0U);
        for (const unsigned shift : {0U, 8U, 16U})
            encoder.number(static_cast<std::uint8_t>(header >> shift));
        encoder.raw(part);
    }
    return frame;
}

void unpack_chunk(mcap::Encoder& encoder, View content) {
    mcap::Decoder decoder(content);
    const View times = decoder.raw(24);
    decoder.number<std::uint32_t>();
    const bool packed = decoder.text() == "zstd";
    decoder.number<std::uint64_t>();
    const Bytes bytes =
        packed ? unpacked(decoder.rest()) : Bytes(decoder.rest().begin(), decoder.rest().end());
    encoder.raw(times);
    encoder.number(std::uint32_t{0});
    encoder.text("");
    encoder.number(std::uint64_t{bytes.size()});
    encoder.raw(bytes);
}

void unpack_attachment(mcap::Encoder& encoder, View content) {
    mcap::Decoder decoder(content);
    encoder.raw(decoder.raw(16));
    const std::string name = decoder.text();
    encoder.text(name);
    encoder.text(decoder.text());
    const View data = decoder.raw(decoder.number<std::uint64_t>());
    const Bytes bytes =
        name.ends_with(".zst") ? raw_frame(unpacked(data)) : Bytes(data.begin(), data.end());
    encoder.number(std::uint64_t{bytes.size()});
    encoder.raw(bytes);
    encoder.number(std::uint32_t{0});
}

/// The records that the reader looks at, unpacked.
Bytes unpacked_records(View trace) {
    Bytes out;
    mcap::Encoder encoder(out);
    bool ended = false;
    mcap::walk(trace.subspan(8, trace.size() - 16), [&](const mcap::Record& record) {
        ended = ended || record.op == mcap::Op::data_end;
        const bool wanted = record.op == mcap::Op::chunk || record.op == mcap::Op::attachment ||
                            record.op == mcap::Op::metadata;
        if (ended || !wanted)
            return;
        encoder.begin(record.op);
        if (record.op == mcap::Op::chunk)
            unpack_chunk(encoder, record.content);
        else if (record.op == mcap::Op::attachment)
            unpack_attachment(encoder, record.content);
        else
            encoder.raw(record.content);
        encoder.end();
    });
    return out;
}

void write_both(const fs::path& folder, const std::string& name, const Bytes& trace) {
    Bytes whole{whole_file};
    whole.insert(whole.end(), trace.begin(), trace.end());
    write_file(folder / (name + ".whole"), whole);
    Bytes loose{records};
    const Bytes all = unpacked_records(trace);
    loose.insert(loose.end(), all.begin(), all.end());
    write_file(folder / (name + ".records"), loose);
}

/// Whom a slice of later ticks has to know.
void spawn_somebody(world::TickDraft& draft) {
    world::CommandT command;
    command.kind = world::CommandKind::spawn;
    command.actor = 1;
    command.text = "ego";
    draft.tick.commands.push_back(command);
}

}  // namespace

void write_seeds(const fs::path& folder) {
    fs::create_directories(folder);
    const fs::path made = folder / "made.mcap";
    for (const SyntheticRun& run :
         {SyntheticRun{.ticks = 0},
          SyntheticRun{.ticks = 2, .cars = 1},
          SyntheticRun{.ticks = 41, .cars = 2},
          SyntheticRun{.ticks = 66, .cars = 0, .change = at(5, spawn_somebody)}}) {
        write_trace(made, run);
        write_both(folder, "made" + std::to_string(run.ticks), read_file(made));
    }
    const fs::path cut = folder / "cut.mcap";
    replay::TraceReader trace(made);  // the last of them
    replay::slice(trace, 60, 66, cut);
    write_both(folder, "slice", read_file(cut));
    fs::remove(cut);
    fs::remove(made);
}

}  // namespace reprise::test

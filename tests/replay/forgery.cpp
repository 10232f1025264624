#include "tests/replay/forgery.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "replay/mcap/compression.h"
#include "replay/trace_format.h"

namespace reprise::test {

namespace {

namespace mcap = replay::mcap;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t crc_size = 4;

template <typename T>
T number_at(const Bytes& file, std::size_t at) {
    T value{};
    std::memcpy(&value, file.data() + at, sizeof(T));
    return value;
}

template <typename T>
void put_number(Bytes& file, std::size_t at, T value) {
    std::memcpy(file.data() + at, &value, sizeof(T));
}

/// The frame or the plain bytes in a Chunk record, unpacked; nothing when that is not possible.
std::optional<Bytes> unpacked(mcap::View frame, std::uint64_t size, bool plain) {
    if (plain)
        return Bytes(frame.begin(), frame.end());
    if (size > replay::largest_unpacked)
        return std::nullopt;
    Bytes out(size);
    if (!replay::Decompressor().decompress(frame, out))
        return std::nullopt;
    return out;
}

std::optional<Bytes> unpacked_chunk(const Bytes& file, const FileRecord& record) {
    mcap::Decoder chunk(mcap::View(file).subspan(record.from + 9, record.size - 9));
    chunk.raw(16);  // times
    const auto size = chunk.number<std::uint64_t>();
    chunk.number<std::uint32_t>();
    const bool plain = chunk.text().empty();
    return unpacked(chunk.raw(chunk.number<std::uint64_t>()), size, plain);
}

void repair_metadata(Bytes& file, const FileRecord& record) {
    mcap::Decoder content(mcap::View(file).subspan(record.from + 9, record.size - 9));
    content.text();
    const auto texts = content.texts();
    const std::string check = replay::format::with_check(texts).at("check");
    const std::string key("check\x20\0\0\0", 9);
    const auto end = file.begin() + static_cast<std::ptrdiff_t>(record.from + record.size);
    const auto at = std::search(
        file.begin() + static_cast<std::ptrdiff_t>(record.from), end, key.begin(), key.end());
    if (end - at >= 9 + 32)
        std::copy(check.begin(), check.end(), at + 9);
}

void repair(Bytes& file, const FileRecord& record) {
    const mcap::View all(file);
    switch (record.op) {
        case mcap::Op::chunk:
            if (const auto data = unpacked_chunk(file, record))
                put_number(file, record.from + mcap::chunk_crc_at, mcap::crc32(*data));
            return;
        case mcap::Op::attachment:
            put_number(file,
                       record.from + record.size - crc_size,
                       mcap::crc32(all.subspan(record.from + 9, record.size - 9 - crc_size)));
            return;
        case mcap::Op::metadata:
            return repair_metadata(file, record);
        case mcap::Op::data_end:
            put_number(file, record.from + 9, mcap::crc32(all.first(record.from)));
            return;
        case mcap::Op::footer: {
            const auto start = number_at<std::uint64_t>(file, record.from + 9);
            const std::size_t crc_at = record.from + 9 + 16;
            if (start <= crc_at)
                put_number(file, crc_at, mcap::crc32(all.subspan(start, crc_at - start)));
            return;
        }
        default:
            return;
    }
}

}  // namespace

std::vector<FileRecord> records_of(const Bytes& file) {
    std::vector<FileRecord> records;
    try {
        mcap::walk(mcap::View(file).subspan(8, file.size() - 16), [&](const mcap::Record& record) {
            records.push_back({record.op, record.at + 8, record.content.size() + 9});
        });
    } catch (const mcap::Malformed&) {
        // What could be walked.
    }
    return records;
}

void repair_checksums(Bytes& file) {
    for (const FileRecord& record : records_of(file)) {
        try {
            repair(file, record);
        } catch (const mcap::Malformed&) {
            // There is no checksum in what is no such record any more.
        }
    }
}

void insert_record(Bytes& file, const Bytes& record, bool in_summary) {
    const std::size_t footer = file.size() - mcap::tail_size + 9;
    const auto summary = number_at<std::uint64_t>(file, footer);
    const auto offsets = number_at<std::uint64_t>(file, footer + 8);
    const std::uint64_t at = in_summary ? offsets : summary - mcap::data_end_size;
    if (!in_summary) {
        put_number(file, footer, summary + record.size());
        for (const FileRecord& group : records_of(file))
            if (group.op == mcap::Op::summary_offset)
                put_number(file,
                           group.from + 10,
                           number_at<std::uint64_t>(file, group.from + 10) + record.size());
    }
    put_number(file, footer + 8, offsets + record.size());
    file.insert(file.begin() + static_cast<std::ptrdiff_t>(at), record.begin(), record.end());
    repair_checksums(file);
}

Bytes unpacked_parts(const Bytes& file) {
    Bytes parts;
    const auto add = [&](const std::optional<Bytes>& part) {
        if (part)
            parts.insert(parts.end(), part->begin(), part->end());
    };
    for (const FileRecord& record : records_of(file)) {
        try {
            if (record.op == mcap::Op::chunk)
                add(unpacked_chunk(file, record));
            if (record.op != mcap::Op::attachment)
                continue;
            mcap::Decoder content(mcap::View(file).subspan(record.from + 9, record.size - 9));
            content.raw(16);
            content.text();
            const bool plain = content.text() != "application/zstd";
            const mcap::View data = content.raw(content.number<std::uint64_t>());
            add(unpacked(data, replay::unpacked_size(data).value_or(0), plain));
        } catch (const mcap::Malformed&) {
            continue;
        }
    }
    return parts;
}

}  // namespace reprise::test

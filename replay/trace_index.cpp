#include "replay/trace_index.h"

#include <algorithm>

#include <fmt/format.h>

#include "replay/mcap/compression.h"
#include "replay/trace_format.h"

namespace reprise::replay {

namespace {

/// The record of this opcode and length, prefix stripped.
mcap::Bytes read_record(const InputFile& file, mcap::Op op, std::uint64_t at, std::uint64_t size) {
    mcap::Bytes bytes = file.read(at, size);
    mcap::Decoder prefix(bytes);
    if (prefix.number<std::uint8_t>() != static_cast<std::uint8_t>(op) ||
        prefix.number<std::uint64_t>() != size - mcap::prefix_size)
        throw mcap::Malformed("another record is in its place");
    bytes.erase(bytes.begin(), bytes.begin() + mcap::prefix_size);
    return bytes;
}

void check_start(const InputFile& file) {
    mcap::Bytes start = file.read(0, std::min<std::uint64_t>(file.size(), mcap::magic.size()));
    if (start.empty())
        file.fail(0, "not a trace: the file is empty");
    if (!std::equal(start.begin(), start.end(), mcap::magic.begin()))
        file.fail(0, "not a trace: it does not begin like an MCAP file");
}

/// A record within the data section.
bool lies_within(std::uint64_t offset, std::uint64_t length, std::uint64_t end) {
    return offset >= mcap::magic.size() && offset <= end && length >= mcap::prefix_size &&
           length <= end - offset;
}

void check(const mcap::Chunk& chunk, std::uint64_t end) {
    if (!lies_within(chunk.offset, chunk.length, end) || chunk.compressed_size > chunk.length ||
        chunk.length != mcap::chunk_header_size(chunk) + chunk.compressed_size)
        throw mcap::Malformed("a chunk lies outside of the file");
    if (chunk.message_index_length > end - chunk.offset - chunk.length)
        throw mcap::Malformed("message indexes lie outside of the file");
    if (chunk.compression != "zstd" && chunk.compression != "")
        throw mcap::Malformed("chunks packed as '" + chunk.compression + "', not zstd");
    if (chunk.uncompressed_size > largest_unpacked || chunk.end_time < chunk.start_time)
        throw mcap::Malformed("a chunk of impossible size");
}

void check(const mcap::Attachment& attachment, std::uint64_t end) {
    const std::uint64_t around = mcap::prefix_size + 16 + 4 + attachment.name.size() + 4 +
                                 attachment.media_type.size() + 8 + 4;
    if (!lies_within(attachment.offset, attachment.length, end) ||
        attachment.data_size > attachment.length ||
        attachment.length != around + attachment.data_size)
        throw mcap::Malformed("an attachment lies outside of the file");
}

void check(const mcap::Metadata& metadata, std::uint64_t end) {
    if (!lies_within(metadata.offset, metadata.length, end))
        throw mcap::Malformed("metadata lies outside of the file");
}

/// The footer's summary, checked against its checksum.
mcap::Bytes read_summary(const InputFile& file, mcap::Footer& footer) {
    const std::uint64_t footer_at = file.size() - mcap::tail_size;
    footer = mcap::decode_footer(read_record(file, mcap::Op::footer, footer_at, mcap::footer_size));
    if (footer.summary_start < mcap::magic.size() + mcap::data_end_size ||
        footer.summary_start > footer_at)
        throw mcap::Malformed("it points outside of the file");
    mcap::Bytes summary =
        file.read(footer.summary_start, file.size() - mcap::magic.size() - footer.summary_start);
    if (mcap::crc32(mcap::View(summary).first(summary.size() - 4)) != footer.summary_crc)
        throw mcap::Malformed("its checksum differs");
    summary.resize(summary.size() - mcap::footer_size);
    return summary;
}

TraceIndex decode_summary(mcap::View summary, std::uint64_t data_end) {
    TraceIndex index;
    index.data_end = data_end;
    mcap::Statistics statistics;
    mcap::walk(summary, [&](const mcap::Record& record) {
        if (record.op == mcap::Op::chunk_index)
            index.chunks.push_back(mcap::decode_chunk_index(record.content));
        if (record.op == mcap::Op::attachment_index)
            index.attachments.push_back(mcap::decode_attachment_index(record.content));
        if (record.op == mcap::Op::metadata_index)
            index.metadata.push_back(mcap::decode_metadata_index(record.content));
        if (record.op == mcap::Op::statistics)
            statistics = mcap::decode_statistics(record.content);
    });
    for (const mcap::Chunk& chunk : index.chunks)
        check(chunk, data_end);
    for (const mcap::Attachment& attachment : index.attachments)
        check(attachment, data_end);
    for (const mcap::Metadata& metadata : index.metadata)
        check(metadata, data_end);
    if (statistics.chunks != index.chunks.size())
        throw mcap::Malformed(
            fmt::format("{} chunks of {} are listed", index.chunks.size(), statistics.chunks));
    return index;
}

/// What the index would say about a Chunk record in the data section.
mcap::Chunk chunk_at(const InputFile& file, std::uint64_t at, std::uint64_t length) {
    const mcap::Bytes start = file.read(at, std::min<std::uint64_t>(length, 256));
    mcap::Decoder record(mcap::View(start).subspan(mcap::prefix_size));
    mcap::Chunk chunk;
    chunk.offset = at;
    chunk.length = length;
    chunk.start_time = record.number<std::uint64_t>();
    chunk.end_time = record.number<std::uint64_t>();
    chunk.uncompressed_size = record.number<std::uint64_t>();
    record.number<std::uint32_t>();  // checksum
    chunk.compression = record.text();
    chunk.compressed_size = record.number<std::uint64_t>();
    check(chunk, file.size());
    return chunk;
}

mcap::Attachment attachment_at(const InputFile& file, std::uint64_t at, std::uint64_t length) {
    const mcap::Bytes start = file.read(at, std::min<std::uint64_t>(length, 4096));
    mcap::Decoder record(mcap::View(start).subspan(mcap::prefix_size));
    mcap::Attachment attachment{at, length, 0, "", ""};
    record.raw(16);  // log and create time
    attachment.name = record.text();
    attachment.media_type = record.text();
    attachment.data_size = record.number<std::uint64_t>();
    check(attachment, file.size());
    return attachment;
}

mcap::Metadata metadata_at(const InputFile& file, std::uint64_t at, std::uint64_t length) {
    const mcap::Bytes start = file.read(at, std::min<std::uint64_t>(length, 4096));
    mcap::Decoder record(mcap::View(start).subspan(mcap::prefix_size));
    return {at, length, record.text()};
}

}  // namespace

std::optional<TraceIndex> read_index(const InputFile& file) {
    check_start(file);
    if (file.size() < mcap::magic.size() + mcap::data_end_size + mcap::tail_size)
        return std::nullopt;
    const mcap::Bytes end = file.read(file.size() - mcap::magic.size(), mcap::magic.size());
    if (!std::equal(end.begin(), end.end(), mcap::magic.begin()))
        return std::nullopt;
    mcap::Footer footer;
    try {
        const mcap::Bytes summary = read_summary(file, footer);
        const std::uint64_t data_end = footer.summary_start - mcap::data_end_size;
        read_record(file, mcap::Op::data_end, data_end, mcap::data_end_size);
        return decode_summary(summary, data_end);
    } catch (const mcap::Malformed& error) {
        const bool found = footer.summary_start > 0 && footer.summary_start < file.size();
        file.fail(found ? footer.summary_start : file.size() - mcap::tail_size,
                  fmt::format("the index is damaged ({}); `reprise recover` makes it anew",
                              error.what()));
    }
}

TraceIndex scan(const InputFile& file) {
    TraceIndex index;
    index.whole = false;
    std::uint64_t at = mcap::magic.size();
    try {
        while (at < file.size() && file.size() - at >= mcap::prefix_size) {
            const mcap::Bytes bytes = file.read(at, mcap::prefix_size);
            mcap::Decoder prefix(bytes);
            const auto op = static_cast<mcap::Op>(prefix.number<std::uint8_t>());
            const auto content = prefix.number<std::uint64_t>();
            if (op == mcap::Op{} || op == mcap::Op::data_end || op == mcap::Op::footer ||
                content > file.size() - at - mcap::prefix_size)
                break;
            const std::uint64_t length = mcap::prefix_size + content;
            if (op == mcap::Op::chunk)
                index.chunks.push_back(chunk_at(file, at, length));
            if (op == mcap::Op::attachment)
                index.attachments.push_back(attachment_at(file, at, length));
            if (op == mcap::Op::metadata)
                index.metadata.push_back(metadata_at(file, at, length));
            at += length;
        }
    } catch (const mcap::Malformed&) {
        // The record that does not decode is where the good part ends.
    }
    index.data_end = at;
    return index;
}

const mcap::Attachment* find_attachment(const TraceIndex& index, const std::string& name) {
    const auto found = std::find_if(index.attachments.begin(),
                                    index.attachments.end(),
                                    [&](const auto& entry) { return entry.name == name; });
    return found == index.attachments.end() ? nullptr : &*found;
}

const mcap::Metadata* find_metadata(const TraceIndex& index, const std::string& name) {
    const auto found = std::find_if(index.metadata.begin(),
                                    index.metadata.end(),
                                    [&](const auto& entry) { return entry.name == name; });
    return found == index.metadata.end() ? nullptr : &*found;
}

mcap::Bytes read_attachment(const InputFile& file,
                            const TraceIndex& index,
                            const std::string& name) {
    const mcap::Attachment* entry = find_attachment(index, name);
    if (entry == nullptr)
        file.fail(0, fmt::format("the trace has no '{}'; was it made by another program?", name));
    try {
        const mcap::Bytes bytes =
            read_record(file, mcap::Op::attachment, entry->offset, entry->length);
        mcap::Decoder record(bytes);
        record.raw(16);  // log and create time
        const bool same = record.text() == entry->name && record.text() == entry->media_type &&
                          record.number<std::uint64_t>() == entry->data_size;
        if (!same)
            throw mcap::Malformed("its header differs from the index");
        const mcap::View data = record.raw(entry->data_size);
        if (record.number<std::uint32_t>() !=
            mcap::crc32(mcap::View(bytes).first(bytes.size() - 4)))
            throw mcap::Malformed("its checksum differs");
        return {data.begin(), data.end()};
    } catch (const mcap::Malformed& error) {
        file.fail(entry->offset,
                  fmt::format("the attachment '{}' is damaged ({}); use a copy of the trace",
                              name,
                              error.what()));
    }
}

mcap::Bytes read_packed_attachment(const InputFile& file,
                                   const TraceIndex& index,
                                   const std::string& name) {
    const mcap::Bytes packed = read_attachment(file, index, name);
    mcap::Bytes data;
    const auto size = unpacked_size(packed);
    if (size)
        data.resize(*size);
    if (!size || !Decompressor().decompress(packed, data))
        file.fail(find_attachment(index, name)->offset,
                  fmt::format("the attachment '{}' cannot be unpacked", name));
    return data;
}

std::optional<std::map<std::string, std::string>> read_metadata(const InputFile& file,
                                                                const TraceIndex& index,
                                                                const std::string& name) {
    const mcap::Metadata* entry = find_metadata(index, name);
    if (entry == nullptr)
        return std::nullopt;
    try {
        const mcap::Bytes bytes =
            read_record(file, mcap::Op::metadata, entry->offset, entry->length);
        mcap::Decoder record(bytes);
        if (record.text() != name)
            throw mcap::Malformed("it has another name");
        auto texts = record.texts();
        if (!format::check_holds(texts))
            throw mcap::Malformed("its checksum differs");
        return texts;
    } catch (const mcap::Malformed& error) {
        file.fail(entry->offset,
                  fmt::format("the metadata '{}' is damaged ({}); use a copy", name, error.what()));
    }
}

}  // namespace reprise::replay

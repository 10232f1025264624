#include "tests/fuzz/finished_trace.h"

#include <cstring>
#include <optional>

#include <zstd.h>

#include "replay/trace_format.h"

namespace reprise::test {

namespace {

namespace mcap = replay::mcap;
using mcap::Bytes;
using mcap::View;

constexpr std::uint64_t largest = 1 << 20;  // of an unpacked chunk: time, not safety

void put_crc(Bytes& out, std::size_t at, std::uint32_t crc) {
    std::memcpy(out.data() + at, &crc, sizeof(crc));
}

/// The checksum that this chunk should have; 0 where none can be told.
std::uint32_t crc_of(View packed, const mcap::Chunk& chunk) {
    if (chunk.compression != "zstd")
        return mcap::crc32(packed);
    if (chunk.uncompressed_size > largest)
        return 0;
    Bytes records(chunk.uncompressed_size);
    const std::size_t size =
        ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size());
    return ZSTD_isError(size) != 0 ? 0 : mcap::crc32(View(records).first(size));
}

/// Copies records one by one, and notes what the index says about them.
class Finisher {
  public:
    Finisher() : out_(mcap::magic.begin(), mcap::magic.end()) {}

    void add(const mcap::Record& record) {
        if (record.op == mcap::Op::data_end || record.op == mcap::Op::footer)
            return;
        at_ = out_.size();
        mcap::Encoder encoder(out_);
        encoder.begin(record.op);
        encoder.raw(record.content);
        encoder.end();
        try {
            if (record.op == mcap::Op::chunk)
                add_chunk(record.content);
            if (record.op == mcap::Op::attachment)
                add_attachment(record.content);
            if (record.op == mcap::Op::metadata)
                add_metadata(record.content);
        } catch (const mcap::Malformed&) {
            // Left as it is, and out of the index.
        }
    }

    Bytes finish() {
        const std::uint32_t crc = mcap::crc32(out_);
        mcap::Encoder encoder(out_);
        encoder.begin(mcap::Op::data_end);
        encoder.number(crc);
        encoder.end();
        const std::uint64_t start = out_.size();
        mcap::encode(out_, statistics_);
        out_.insert(out_.end(), index_.begin(), index_.end());
        encoder.number(static_cast<std::uint8_t>(mcap::Op::footer));
        encoder.number(mcap::footer_size - mcap::prefix_size);
        encoder.number(start);
        encoder.number(std::uint64_t{0});  // no summary offsets
        encoder.number(mcap::crc32(View(out_).subspan(start)));
        encoder.raw(mcap::magic);
        return std::move(out_);
    }

  private:
    std::uint64_t length() const { return out_.size() - at_; }

    void add_chunk(View content) {
        mcap::Decoder decoder(content);
        mcap::Chunk chunk;
        chunk.start_time = decoder.number<std::uint64_t>();
        chunk.end_time = decoder.number<std::uint64_t>();
        chunk.uncompressed_size = decoder.number<std::uint64_t>();
        decoder.number<std::uint32_t>();
        chunk.compression = decoder.text();
        chunk.compressed_size = decoder.number<std::uint64_t>();
        chunk.offset = at_;
        chunk.length = length();
        put_crc(out_, at_ + mcap::chunk_crc_at, crc_of(decoder.rest(), chunk));
        mcap::encode_index(index_, chunk);
        ++statistics_.chunks;
    }

    void add_attachment(View content) {
        mcap::Decoder decoder(content);
        decoder.raw(16);
        mcap::Attachment attachment{at_, length(), 0, decoder.text(), decoder.text()};
        attachment.data_size = decoder.number<std::uint64_t>();
        decoder.raw(attachment.data_size);
        if (decoder.rest().size() == 4)
            put_crc(out_, out_.size() - 4, mcap::crc32(content.first(content.size() - 4)));
        mcap::encode_index(index_, attachment);
        ++statistics_.attachments;
    }

    void add_metadata(View content) {
        mcap::Decoder decoder(content);
        const std::string name = decoder.text();
        const auto texts = replay::format::with_check(decoder.texts());
        out_.resize(at_);
        mcap::Encoder encoder(out_);
        encoder.begin(mcap::Op::metadata);
        encoder.text(name);
        encoder.texts(texts);
        encoder.end();
        mcap::encode_index(index_, mcap::Metadata{at_, length(), name});
        ++statistics_.metadata;
    }

    Bytes out_;
    Bytes index_;
    std::size_t at_ = 0;  ///< of the record on its way
    mcap::Statistics statistics_;
};

}  // namespace

Bytes finished_trace(View records) {
    Finisher finisher;
    try {
        mcap::walk(records, [&](const mcap::Record& record) { finisher.add(record); });
    } catch (const mcap::Malformed&) {
        // The rest is no record.
    }
    return finisher.finish();
}

}  // namespace reprise::test

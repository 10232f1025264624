#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The MCAP container, version 0, as bytes and back: https://mcap.dev/spec. Only the records that a
/// trace needs; nothing here knows what a tick is or touches a file.
namespace reprise::replay::mcap {

static_assert(std::endian::native == std::endian::little, "MCAP is little-endian, and so are we");

using Bytes = std::vector<std::uint8_t>;
using View = std::span<const std::uint8_t>;

inline View view(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

inline constexpr std::array<std::uint8_t, 8> magic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum class Op : std::uint8_t {
    header = 1,
    footer,
    schema,
    channel,
    message,
    chunk,
    message_index,
    chunk_index,
    attachment,
    attachment_index,
    statistics,
    metadata,
    metadata_index,
    summary_offset,
    data_end
};

inline constexpr std::uint64_t prefix_size = 9;         ///< opcode and length of every record
inline constexpr std::uint64_t message_header = 22;     ///< of a message's content, before its data
inline constexpr std::uint64_t footer_size = 9 + 20;    ///< with prefix
inline constexpr std::uint64_t data_end_size = 9 + 4;   ///< with prefix
inline constexpr std::uint64_t tail_size = 9 + 20 + 8;  ///< footer and closing magic

/// CRC-32 of zlib, which MCAP uses everywhere; `before` continues an earlier run of bytes.
std::uint32_t crc32(View bytes, std::uint32_t before = 0);

/// Bytes that are no such record.
class Malformed : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Appends records to a buffer that the caller owns.
class Encoder {
  public:
    explicit Encoder(Bytes& out) : out_(&out) {}

    /// Between begin and end: one record's content. Records do not nest.
    void begin(Op op);
    void end();

    template <std::integral T>
    void number(T value) {
        raw({reinterpret_cast<const std::uint8_t*>(&value), sizeof(T)});
    }

    void text(std::string_view text);
    void texts(const std::map<std::string, std::string>& texts);

    void raw(View bytes) { out_->insert(out_->end(), bytes.begin(), bytes.end()); }

  private:
    Bytes* out_;
    std::size_t length_at_ = 0;
};

/// Takes a record's content apart; distrusts every length. Throws Malformed.
class Decoder {
  public:
    explicit Decoder(View bytes) : left_(bytes) {}

    template <std::integral T>
    T number() {
        T value{};
        const View bytes = raw(sizeof(T));
        std::memcpy(&value, bytes.data(), sizeof(T));
        return value;
    }

    std::string text();
    std::map<std::string, std::string> texts();
    View raw(std::uint64_t size);

    View rest() const { return left_; }

  private:
    View left_;
};

/// One record, borrowed from the bytes it was found in.
struct Record {
    Op op;
    View content;
    std::uint64_t at = 0;  ///< of its prefix, in the bytes walked
};

/// Calls visit(record) for every record in turn. Throws Malformed where the records end early.
template <typename Visit>
void walk(View bytes, Visit visit) {
    std::uint64_t at = 0;
    while (at < bytes.size()) {
        Decoder prefix(bytes.subspan(at));
        const auto op = static_cast<Op>(prefix.number<std::uint8_t>());
        const View content = prefix.raw(prefix.number<std::uint64_t>());
        visit(Record{op, content, at});
        at += prefix_size + content.size();
    }
}

struct Chunk {
    std::uint64_t start_time = 0;
    std::uint64_t end_time = 0;
    std::uint64_t offset = 0;  ///< of the record's prefix in the file
    std::uint64_t length = 0;  ///< of the record with its prefix
    std::vector<std::pair<std::uint16_t, std::uint64_t>> message_indexes;  ///< channel, file offset
    std::uint64_t message_index_length = 0;
    std::string compression;
    std::uint64_t compressed_size = 0;
    std::uint64_t uncompressed_size = 0;
};

struct Attachment {
    std::uint64_t offset = 0;
    std::uint64_t length = 0;  ///< of the record with its prefix
    std::uint64_t data_size = 0;
    std::string name;
    std::string media_type;
};

struct Metadata {
    std::uint64_t offset = 0;
    std::uint64_t length = 0;  ///< of the record with its prefix
    std::string name;
};

struct Statistics {
    std::uint64_t messages = 0;
    std::uint16_t schemas = 0;
    std::uint32_t channels = 0;
    std::uint32_t attachments = 0;
    std::uint32_t metadata = 0;
    std::uint32_t chunks = 0;
    std::uint64_t start_time = 0;
    std::uint64_t end_time = 0;
    std::vector<std::pair<std::uint16_t, std::uint64_t>> messages_of;  ///< channel, count
};

struct Footer {
    std::uint64_t summary_start = 0;
    std::uint64_t summary_offset_start = 0;
    std::uint32_t summary_crc = 0;
};

/// The prefix and content of a Chunk record up to its compressed bytes.
void encode_chunk_header(Bytes& out, const Chunk& chunk, std::uint32_t uncompressed_crc);

/// Size of what encode_chunk_header writes.
std::uint64_t chunk_header_size(const Chunk& chunk);

/// Offset of uncompressed_crc in a Chunk record with its prefix.
inline constexpr std::uint64_t chunk_crc_at = prefix_size + 3 * 8;

/// A MessageIndex record: log time of each message, and where it lies in the unpacked chunk.
using MessageEntries = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
void encode_message_index(Bytes& out, std::uint16_t channel, const MessageEntries& entries);

/// Size of what encode_message_index writes, with its prefix.
constexpr std::uint64_t message_index_size(std::uint64_t messages) {
    return prefix_size + 2 + 4 + 16 * messages;
}

void encode_index(Bytes& out, const Chunk& chunk);
void encode_index(Bytes& out, const Attachment& attachment);
void encode_index(Bytes& out, const Metadata& metadata);
void encode(Bytes& out, const Statistics& statistics);

Chunk decode_chunk_index(View content);
Attachment decode_attachment_index(View content);
Metadata decode_metadata_index(View content);
Statistics decode_statistics(View content);
Footer decode_footer(View content);

}  // namespace reprise::replay::mcap

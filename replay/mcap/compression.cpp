#include "replay/mcap/compression.h"

#include <new>

#include <zstd.h>

#include "world/check.h"

namespace reprise::replay {

struct Compressor::Context {
    ZSTD_CCtx* zstd = ZSTD_createCCtx();
    mcap::Bytes packed;
};

Compressor::Compressor() : context_(std::make_unique<Context>()) {
    if (context_->zstd == nullptr)
        throw std::bad_alloc();
}

Compressor::~Compressor() {
    ZSTD_freeCCtx(context_->zstd);
}

mcap::View Compressor::compress(mcap::View bytes) {
    mcap::Bytes& packed = context_->packed;
    if (packed.size() < ZSTD_compressBound(bytes.size()))
        packed.resize(ZSTD_compressBound(bytes.size()));
    const std::size_t size = ZSTD_compressCCtx(
        context_->zstd, packed.data(), packed.size(), bytes.data(), bytes.size(), 1);
    REPRISE_CHECK(!ZSTD_isError(size), ZSTD_getErrorName(size));
    return mcap::View(packed).first(size);
}

struct Decompressor::Context {
    ZSTD_DCtx* zstd = ZSTD_createDCtx();
};

Decompressor::Decompressor() : context_(std::make_unique<Context>()) {
    if (context_->zstd == nullptr)
        throw std::bad_alloc();
}

Decompressor::~Decompressor() {
    ZSTD_freeDCtx(context_->zstd);
}

bool Decompressor::decompress(mcap::View frame, std::span<std::uint8_t> out) {
    return is_one_frame(frame) &&
           ZSTD_decompressDCtx(
               context_->zstd, out.data(), out.size(), frame.data(), frame.size()) == out.size();
}

std::size_t Decompressor::salvage(mcap::View frame, std::span<std::uint8_t> out) {
    ZSTD_DCtx_reset(context_->zstd, ZSTD_reset_session_only);
    ZSTD_inBuffer in{frame.data(), frame.size(), 0};
    ZSTD_outBuffer unpacked{out.data(), out.size(), 0};
    while (unpacked.pos < unpacked.size) {
        const std::size_t in_before = in.pos;
        const std::size_t out_before = unpacked.pos;
        const std::size_t left = ZSTD_decompressStream(context_->zstd, &unpacked, &in);
        if (ZSTD_isError(left) || left == 0 || (in.pos == in_before && unpacked.pos == out_before))
            break;
    }
    ZSTD_DCtx_reset(context_->zstd, ZSTD_reset_session_only);
    return unpacked.pos;
}

bool is_one_frame(mcap::View bytes) {
    return ZSTD_findFrameCompressedSize(bytes.data(), bytes.size()) == bytes.size();
}

std::optional<std::uint64_t> unpacked_size(mcap::View frame) {
    // Both error values of zstd lie above the limit.
    const unsigned long long size = ZSTD_getFrameContentSize(frame.data(), frame.size());
    if (size > largest_unpacked)
        return std::nullopt;
    return size;
}

}  // namespace reprise::replay

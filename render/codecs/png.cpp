#include "render/codecs/png.h"

#include <bit>
#include <csetjmp>
#include <cstring>
#include <string>

#include <png.h>
#include <zlib.h>

#include "render/codecs/grain_png.h"
#include "world/check.h"

namespace reprise::render {

namespace {

static_assert(std::endian::native == std::endian::little, "PNG keeps the high byte first");

void append(png_structp png, png_bytep bytes, png_size_t size) {
    auto& file = *static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
    file.insert(file.end(), bytes, bytes + size);
}

void flush_nothing(png_structp /*png*/) {}

void take(png_structp png, png_bytep bytes, png_size_t size) {
    auto& left = *static_cast<std::span<const std::uint8_t>*>(png_get_io_ptr(png));
    if (size > left.size())
        png_error(png, "ends too early");
    std::memcpy(bytes, left.data(), size);
    left = left.subspan(size);
}

/// libpng prints to stderr unless somebody hears it.
void hear_nothing(png_structp /*png*/, png_const_charp /*warning*/) {}

[[noreturn]] void jump_back(png_structp png, png_const_charp /*error*/) {
    png_longjmp(png, 1);
}

void say_packing(png_structp png, PngPacking packing) {
    if (packing != PngPacking::grain)
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_compression_level(png, Z_BEST_SPEED);
    png_set_compression_strategy(png,
                                 packing == PngPacking::grain  ? Z_HUFFMAN_ONLY
                                 : packing == PngPacking::runs ? Z_RLE
                                                               : Z_DEFAULT_STRATEGY);
}

/// False where libpng gave up. It jumps over what stands here: nothing here has a destructor.
bool write(png_structp png, png_infop info, const Numbers& numbers, PngPacking packing) {
    if (setjmp(png_jmpbuf(png)) != 0)  // NOLINT(cert-err52-cpp): libpng's way to fail
        return false;
    const bool wide = numbers.type == world::PixelType::u16;
    say_packing(png, packing);
    png_set_IHDR(png,
                 info,
                 static_cast<png_uint_32>(numbers.width),
                 static_cast<png_uint_32>(numbers.height),
                 wide ? 16 : 8,
                 numbers.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    if (wide)
        png_set_swap(png);
    for (int y = 0; y < numbers.height; ++y)
        png_write_row(png, numbers.data.data() + static_cast<std::size_t>(y) * numbers.row_bytes());
    png_write_end(png, info);
    return true;
}

/// The shape of what is to come, in which palettes and few bits are widened already.
bool read_shape(png_structp png, png_infop info, Numbers& shape) {
    if (setjmp(png_jmpbuf(png)) != 0)  // NOLINT(cert-err52-cpp): libpng's way to fail
        return false;
    png_read_info(png, info);
    png_set_expand(png);
    png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const std::int64_t width = png_get_image_width(png, info);
    const std::int64_t height = png_get_image_height(png, info);
    if (width * height > most_pixels_read)
        return false;
    shape.width = static_cast<int>(width);
    shape.height = static_cast<int>(height);
    shape.channels = png_get_channels(png, info);
    shape.type = png_get_bit_depth(png, info) == 16 ? world::PixelType::u16 : world::PixelType::u8;
    return png_get_rowbytes(png, info) == shape.row_bytes();
}

bool read_rows(png_structp png, png_bytepp rows) {
    if (setjmp(png_jmpbuf(png)) != 0)  // NOLINT(cert-err52-cpp): libpng's way to fail
        return false;
    png_read_image(png, rows);
    png_read_end(png, nullptr);
    return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Numbers& numbers, PngPacking packing) {
    REPRISE_CHECK(
        numbers.width > 0 && numbers.height > 0 &&
            numbers.data.size() == numbers.row_bytes() * static_cast<std::size_t>(numbers.height) &&
            (numbers.channels == 1 || numbers.channels == 3) &&
            numbers.type != world::PixelType::f32,
        "a picture of " + std::to_string(numbers.data.size()) + " bytes");
    if (packing == PngPacking::grain && numbers.type == world::PixelType::u8)
        return encode_grain_png(numbers);
    std::vector<std::uint8_t> file;
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, jump_back, hear_nothing);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    bool written = false;
    if (info != nullptr) {
        png_set_write_fn(png, &file, append, flush_nothing);
        written = write(png, info, numbers, packing);
    }
    png_destroy_write_struct(&png, &info);
    REPRISE_CHECK(written, "libpng gave up");
    return file;
}

std::optional<Numbers> decode_png(std::span<const std::uint8_t> bytes) {
    Numbers numbers;
    std::vector<png_bytep> rows;
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, jump_back, hear_nothing);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    bool whole = false;
    if (info != nullptr) {
        png_set_read_fn(png, &bytes, take);
        if (read_shape(png, info, numbers)) {
            numbers.data.resize(numbers.row_bytes() * static_cast<std::size_t>(numbers.height));
            for (int y = 0; y < numbers.height; ++y)
                rows.push_back(numbers.data.data() +
                               static_cast<std::size_t>(y) * numbers.row_bytes());
            whole = read_rows(png, rows.data());
        }
    }
    png_destroy_read_struct(&png, &info, nullptr);
    return whole ? std::optional(std::move(numbers)) : std::nullopt;
}

}  // namespace reprise::render

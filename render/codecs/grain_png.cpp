// How it goes: each row is written with each of PNG's five filters (PNG specification, 9.2),
// sixteen
//   bytes at once; of these stays the one whose bytes, taken as signed, have the least sum of
//   magnitudes (12.8), of equal ones the first. Then the rows are packed, see literal_deflate.h.
#include "render/codecs/grain_png.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <string_view>

#include <emmintrin.h>
#include <zlib.h>

#include "render/codecs/literal_deflate.h"

namespace reprise::render {

namespace {

constexpr std::size_t chunk = 16;
constexpr std::size_t before = 16;  // zeros to the left of a row: a pixel's bytes and more
constexpr std::size_t filters = 5;

__m128i load(const std::uint8_t* from) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
}

/// The mean, rounded down.
__m128i mean_guess(__m128i a, __m128i b) {
    const __m128i odd = _mm_and_si128(_mm_xor_si128(a, b), _mm_set1_epi8(1));
    return _mm_sub_epi8(_mm_avg_epu8(a, b), odd);
}

__m128i magnitude(__m128i words) {
    return _mm_max_epi16(words, _mm_sub_epi16(_mm_setzero_si128(), words));
}

/// Of eight bytes as words: the one of left, above, corner that is nearest to left + above -
/// corner.
__m128i nearest_of(__m128i left, __m128i above, __m128i corner) {
    const __m128i far_left = magnitude(_mm_sub_epi16(above, corner));
    const __m128i far_above = magnitude(_mm_sub_epi16(left, corner));
    const __m128i far_corner =
        magnitude(_mm_sub_epi16(_mm_add_epi16(left, above), _mm_add_epi16(corner, corner)));
    const __m128i least = _mm_min_epi16(_mm_min_epi16(far_left, far_above), far_corner);
    const auto choose = [](__m128i mask, __m128i yes, __m128i no) {
        return _mm_or_si128(_mm_and_si128(mask, yes), _mm_andnot_si128(mask, no));
    };
    return choose(_mm_cmpeq_epi16(least, far_left),
                  left,
                  choose(_mm_cmpeq_epi16(least, far_above), above, corner));
}

__m128i paeth_guess(__m128i left, __m128i above, __m128i corner) {
    const __m128i zero = _mm_setzero_si128();
    return _mm_packus_epi16(nearest_of(_mm_unpacklo_epi8(left, zero),
                                       _mm_unpacklo_epi8(above, zero),
                                       _mm_unpacklo_epi8(corner, zero)),
                            nearest_of(_mm_unpackhi_epi8(left, zero),
                                       _mm_unpackhi_epi8(above, zero),
                                       _mm_unpackhi_epi8(corner, zero)));
}

/// Two rows with room on both sides, and the later one under every filter.
class Rows {
  public:
    Rows(std::size_t bytes, std::size_t pixel)
        : bytes_(bytes),
          pixel_(pixel),
          last_(before + bytes + chunk, 0),
          own_(last_) {
        for (std::vector<std::uint8_t>& one : filtered_)
            one.resize(bytes + chunk);
    }

    /// Of the filters that `allowed` has, bit by bit, the best for this row; see filtered().
    std::size_t take(const std::uint8_t* row, unsigned allowed) {
        own_.swap(last_);
        std::memcpy(own_.data() + before, row, bytes_);
        Sums sums{};
        for (std::size_t i = 0; i < bytes_; i += chunk)
            filter(i, sums);
        std::size_t best = 0;
        std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
        for (std::size_t k = 0; k < filters; ++k) {
            std::array<std::uint64_t, 2> halves;
            std::memcpy(halves.data(), &sums.of[k], sizeof(halves));
            if ((allowed >> k & 1U) == 0 || halves[0] + halves[1] >= least)
                continue;
            least = halves[0] + halves[1];
            best = k;
        }
        return best;
    }

    std::span<const std::uint8_t> filtered(std::size_t filter) const {
        return std::span(filtered_[filter]).first(bytes_);
    }

  private:
    struct Sums {
        __m128i of[filters];  // NOLINT(modernize-avoid-c-arrays): std::array loses its alignment
    };

    void filter(std::size_t i, Sums& sums) {
        const std::uint8_t* row = own_.data() + before + i;
        const std::uint8_t* last = last_.data() + before + i;
        const __m128i here = load(row);
        const __m128i left = load(row - pixel_);
        const __m128i above = load(last);
        const __m128i corner = load(last - pixel_);
        const Sums all{{here,
                        _mm_sub_epi8(here, left),
                        _mm_sub_epi8(here, above),
                        _mm_sub_epi8(here, mean_guess(left, above)),
                        _mm_sub_epi8(here, paeth_guess(left, above, corner))}};
        // Behind the row's end nothing counts.
        const auto inside = static_cast<char>(std::min(bytes_ - i, chunk));
        const __m128i counts =
            _mm_cmplt_epi8(_mm_setr_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15),
                           _mm_set1_epi8(inside));
        const __m128i zero = _mm_setzero_si128();
        for (std::size_t k = 0; k < filters; ++k) {
            const __m128i own = all.of[k];
            _mm_storeu_si128(reinterpret_cast<__m128i*>(filtered_[k].data() + i), own);
            const __m128i size = _mm_min_epu8(own, _mm_sub_epi8(zero, own));
            sums.of[k] = _mm_add_epi64(sums.of[k], _mm_sad_epu8(_mm_and_si128(size, counts), zero));
        }
    }

    std::size_t bytes_;
    std::size_t pixel_;
    std::vector<std::uint8_t> last_;
    std::vector<std::uint8_t> own_;
    std::array<std::vector<std::uint8_t>, filters> filtered_;
};

/// All rows, each behind the number of its filter.
std::vector<std::uint8_t> filtered_rows(const Numbers& numbers) {
    const std::size_t bytes = numbers.row_bytes();
    const auto height = static_cast<std::size_t>(numbers.height);
    unsigned allowed = 0b11111;
    if (height == 1)
        allowed &= 0b00011;  // nothing above
    if (numbers.width == 1)
        allowed &= 0b00101;  // nothing to the left
    Rows rows(bytes, static_cast<std::size_t>(numbers.channels));
    std::vector<std::uint8_t> all((bytes + 1) * height);
    std::uint8_t* to = all.data();
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t best = rows.take(numbers.data.data() + y * bytes, allowed);
        *to++ = static_cast<std::uint8_t>(best);
        to = std::copy_n(rows.filtered(best).data(), bytes, to);
    }
    return all;
}

void put_number(std::vector<std::uint8_t>& file, std::size_t number) {
    for (int shift = 24; shift >= 0; shift -= 8)
        file.push_back(static_cast<std::uint8_t>(number >> shift & 0xffU));
}

void put_chunk(std::vector<std::uint8_t>& file,
               std::string_view name,
               std::span<const std::uint8_t> data) {
    put_number(file, data.size());
    const std::size_t begin = file.size();
    file.insert(file.end(), name.begin(), name.end());
    file.insert(file.end(), data.begin(), data.end());
    put_number(file, crc32(0, file.data() + begin, static_cast<uInt>(file.size() - begin)));
}

/// A stream says how far back its strings may begin: of a small picture libpng says no more than
/// it has.
void say_window(std::vector<std::uint8_t>& stream, std::size_t bytes) {
    unsigned window = 7;  // 2^(window + 8)
    if (bytes > 16384)
        return;
    while (window > 0 && bytes <= std::size_t{1} << (window + 7))
        --window;
    const unsigned first = window << 4U | 8U;
    stream[0] = static_cast<std::uint8_t>(first);
    stream[1] = static_cast<std::uint8_t>(31 - (first << 8U) % 31);
}

}  // namespace

std::vector<std::uint8_t> encode_grain_png(const Numbers& numbers) {
    constexpr std::size_t part = 8192;  // of the stream, for each chunk
    const std::vector<std::uint8_t> rows = filtered_rows(numbers);
    std::vector<std::uint8_t> stream = deflate_literals(rows);
    say_window(stream, rows.size());
    std::vector<std::uint8_t> file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    file.reserve(stream.size() + stream.size() / 512 + 128);
    std::vector<std::uint8_t> head;
    put_number(head, static_cast<std::size_t>(numbers.width));
    put_number(head, static_cast<std::size_t>(numbers.height));
    const std::uint8_t color = numbers.channels == 1 ? 0 : 2;
    head.insert(head.end(), {8, color, 0, 0, 0});
    put_chunk(file, "IHDR", head);
    for (std::size_t i = 0; i < stream.size(); i += part)
        put_chunk(file, "IDAT", std::span(stream).subspan(i, std::min(part, stream.size() - i)));
    put_chunk(file, "IEND", {});
    return file;
}

}  // namespace reprise::render

#include "exchange/page/number_column.h"

#include <algorithm>
#include <cmath>

#include <zlib.h>

#include "world/check.h"

namespace reprise::exchange {

void NumberColumn::append(std::int64_t value) {
    auto rest = static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63);
    REPRISE_CHECK(rest >> 32 == 0, "a number that a browser would misread");
    for (; rest >= 0x80; rest >>= 7)
        bytes_ += static_cast<char>(0x80 | (rest & 0x7f));
    bytes_ += static_cast<char>(rest);
}

std::int64_t quantised(double value, double per_unit) {
    constexpr double farthest = 1 << 28;  // its second differences still have 31 bits
    if (std::isnan(value))
        return 0;
    return std::llround(std::clamp(value * per_unit, -farthest, farthest));
}

std::string pressed(std::string_view bytes) {
    uLongf size = compressBound(bytes.size());
    std::string out(size, '\0');
    constexpr int level = 9;
    const int code = compress2(reinterpret_cast<Bytef*>(out.data()),
                               &size,
                               reinterpret_cast<const Bytef*>(bytes.data()),
                               bytes.size(),
                               level);
    REPRISE_CHECK(code == Z_OK, "zlib cannot press a page's data");
    out.resize(size);
    return out;
}

}  // namespace reprise::exchange

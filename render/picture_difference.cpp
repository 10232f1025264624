#include "render/picture_difference.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "render/codecs/exr.h"
#include "render/codecs/png.h"

namespace reprise::render {

namespace {

std::optional<Numbers> read(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
    if (path.extension() == ".png")
        return decode_png(bytes);
    if (path.extension() == ".exr")
        return decode_exr(bytes);
    return std::nullopt;
}

double number(const Numbers& numbers, std::size_t index) {
    const auto as = [&]<typename Value>(Value value) {
        std::memcpy(&value, numbers.data.data() + index * sizeof(Value), sizeof(Value));
        return static_cast<double>(value);
    };
    switch (numbers.type) {
        case world::PixelType::u8:
            return as(std::uint8_t{});
        case world::PixelType::u16:
            return as(std::uint16_t{});
        default:
            return as(float{});
    }
}

double peak(world::PixelType type) {
    return type == world::PixelType::u8 ? 255 : type == world::PixelType::u16 ? 65535 : 0;
}

bool are_alike(const Numbers& one, const Numbers& two) {
    return one.width == two.width && one.height == two.height && one.channels == two.channels &&
           one.type == two.type;
}

}  // namespace

std::optional<PictureDifference> picture_difference(const std::filesystem::path& expected,
                                                    const std::filesystem::path& found) {
    const std::optional<Numbers> one = read(expected);
    const std::optional<Numbers> two = read(found);
    if (!one || !two || !are_alike(*one, *two))
        return std::nullopt;
    PictureDifference difference;
    difference.peak = peak(one->type);
    std::size_t index = 0;
    for (int y = 0; y < one->height; ++y)
        for (int x = 0; x < one->width; ++x) {
            bool differs = false;
            for (int c = 0; c < one->channels; ++c, ++index) {
                const double left = number(*one, index);
                const double right = number(*two, index);
                if (left == right || (std::isnan(left) && std::isnan(right)))
                    continue;
                differs = true;
                const double apart = std::isfinite(left) && std::isfinite(right)
                                         ? std::abs(left - right)
                                         : std::numeric_limits<double>::infinity();
                difference.largest = std::max(difference.largest, apart);
                difference.squares += apart * apart;
            }
            if (differs && difference.pixels++ == 0) {
                difference.x = x;
                difference.y = y;
            }
        }
    difference.squares /= static_cast<double>(index);
    return difference;
}

}  // namespace reprise::render

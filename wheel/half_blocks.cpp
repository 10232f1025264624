#include "wheel/half_blocks.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace reprise::wheel {

namespace {

using Mean = std::array<int, 3>;

/// The mean of the pixels that a place of a `columns` x `rows` grid covers, one at least.
Mean mean(const Image& image, int column, int row, int columns, int rows) {
    const auto range = [](int place, int places, int pixels) {
        const int first = place * pixels / places;
        return std::pair(first, std::max((place + 1) * pixels / places, first + 1));
    };
    const auto [left, right] = range(column, columns, image.width);
    const auto [top, bottom] = range(row, rows, image.height);
    Mean sum{};
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            for (std::size_t channel = 0; channel < sum.size(); ++channel)
                sum[channel] +=
                    image.rgb[3 * static_cast<std::size_t>(y * image.width + x) + channel];
    for (int& channel : sum)
        channel /= (right - left) * (bottom - top);
    return sum;
}

/// Colours are said only where they change: a frame is a fraction of the bytes.
void say_color(std::string& text, int layer, const Mean& color, Mean& last) {
    if (color != last)
        text += fmt::format("\x1b[{};2;{};{};{}m", layer, color[0], color[1], color[2]);
    last = color;
}

}  // namespace

std::string half_blocks(const Image& image, int columns, int rows) {
    constexpr int foreground = 38;
    constexpr int background = 48;
    if (image.width <= 0 || image.height <= 0 || columns <= 0 || rows <= 0)
        return "";
    const int wide = std::min(columns, 2 * rows * image.width / image.height);
    const int high = std::min(rows, (wide * image.height / image.width + 1) / 2);
    std::string text;
    for (int row = 0; row < high; ++row) {
        Mean upper{-1, -1, -1};
        Mean lower = upper;
        for (int column = 0; column < wide; ++column) {
            say_color(text, foreground, mean(image, column, 2 * row, wide, 2 * high), upper);
            say_color(text, background, mean(image, column, 2 * row + 1, wide, 2 * high), lower);
            text += "\u2580";
        }
        text += "\x1b[0m\x1b[K\r\n";
    }
    return text;
}

}  // namespace reprise::wheel

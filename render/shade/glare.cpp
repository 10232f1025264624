// What it must do: let lamps shine over their edges by night, as they do in every lens.
// How it goes: what is far brighter than white, on squares of 4 x 4 pixels, is spread along rows
//   and columns by filters that remember (y = a x + (1 - a) y_last, both ways, twice: nearly
//   round), near and far, and added.
// What it keeps: nothing.
#include <algorithm>

#include <tbb/parallel_for.h>

#include "render/shade/frame.h"
#include "render/trace/default_float_mode.h"

namespace reprise::render {

namespace {

constexpr int square = 4;  // [px]

/// [white] Lamps themselves are brighter, see Sky::lamp; what they light is seldom.
constexpr float brim = 2;

/// A small picture of light that is spread.
struct Spread {
    int columns;
    int rows;
    std::vector<Color> light;

    Color* row(int y) {
        return &light[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns)];
    }
};

Spread excess(const Frame& frame) {
    Spread bright{(frame.width + square - 1) / square, (frame.height + square - 1) / square, {}};
    bright.light.resize(static_cast<std::size_t>(bright.columns) *
                        static_cast<std::size_t>(bright.rows));
    tbb::parallel_for(0, bright.rows, [&](int row) {
        const DefaultFloatMode plain;
        Color* sums = bright.row(row);
        std::fill_n(sums, bright.columns, Color::Zero());
        for (int y = row * square; y < std::min((row + 1) * square, frame.height); ++y) {
            const Color* colors = &frame.colors[frame.index(0, y)];
            for (int x = 0; x < frame.width; ++x)
                if (colors[x].maxCoeff() > brim)
                    sums[x / square] += (colors[x] - brim).max(0.0F).min(5.0F) / (square * square);
        }
    });
    return bright;
}

/// Along `count` values that lie `step` apart, there and back.
void remember(Color* values, int count, int step, float keep) {
    Color last = Color::Zero();
    const auto pass = [&](int i) {
        Color& value = values[static_cast<std::ptrdiff_t>(i) * step];
        last = last * keep + value * (1 - keep);
        value = last;
    };
    for (int i = 0; i < count; ++i)
        pass(i);
    last = Color::Zero();
    for (int i = count - 1; i >= 0; --i)
        pass(i);
}

/// `width` in squares: how far the light falls to a third.
void spread_out(Spread& picture, float width) {
    const float keep = width / (1 + width);
    for (int turn = 0; turn < 2; ++turn) {
        tbb::parallel_for(0, picture.rows, [&](int row) {
            const DefaultFloatMode plain;
            remember(picture.row(row), picture.columns, 1, keep);
        });
        tbb::parallel_for(0, picture.columns, [&](int column) {
            const DefaultFloatMode plain;
            remember(picture.row(0) + column, picture.rows, picture.columns, keep);
        });
    }
}

Color between(Spread& picture, float x, float y) {
    const int left = std::clamp(floor_int(x), 0, std::max(0, picture.columns - 2));
    const int top = std::clamp(floor_int(y), 0, std::max(0, picture.rows - 2));
    const float right_share = clamp01(x - static_cast<float>(left));
    const float low_share = clamp01(y - static_cast<float>(top));
    const Color* upper = picture.row(top) + left;
    const Color* lower = picture.row(std::min(top + 1, picture.rows - 1)) + left;
    const int next = left + 1 < picture.columns ? 1 : 0;
    return mix(mix(upper[0], upper[next], right_share),
               mix(lower[0], lower[next], right_share),
               low_share);
}

}  // namespace

void add_glare(Frame& frame, float strength) {
    if (strength <= 0 || frame.width < square || frame.height < square)
        return;
    Spread near = excess(frame);
    Spread far = near;
    const float size = static_cast<float>(frame.width) / square;
    spread_out(near, 0.004F * size);
    spread_out(far, 0.022F * size);
    for (std::size_t i = 0; i < near.light.size(); ++i)
        near.light[i] = (0.28F * near.light[i] + 0.50F * far.light[i]) * strength;
    tbb::parallel_for(0, frame.height, [&](int y) {
        const DefaultFloatMode plain;
        for (int x = 0; x < frame.width; ++x)
            frame.colors[frame.index(x, y)] +=
                between(near,
                        (static_cast<float>(x) + 0.5F) / square - 0.5F,
                        (static_cast<float>(y) + 0.5F) / square - 0.5F);
    });
}

}  // namespace reprise::render

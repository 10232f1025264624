#include "render/shapes/noise.h"

#include <gtest/gtest.h>

namespace reprise::render {
namespace {

/// Calls `check` at places on both sides of the origin and on the lattice, with salts that share a
/// remembered square.
template <typename Check>
void for_places(const Check& check) {
    for (int i = 0; i < 3000; ++i) {
        const float x = static_cast<float>(i % 79) * 0.37F - 14;
        const float y = static_cast<float>(i % 83) * 0.25F - 10;
        check(x, y, static_cast<std::uint32_t>(i % 7 * 128));
    }
}

TEST(Noise, IsTheSameOctaveByOctaveAndAllAtOnce) {
    for (int octaves = 1; octaves <= 4; ++octaves)
        for_places([&](float x, float y, std::uint32_t salt) {
            ASSERT_EQ(fractal_noise(x, y, octaves, salt),
                      fractal_noise_over(-1, x, y, octaves, salt))
                << octaves << " octaves at " << x << ", " << y;
        });
}

TEST(Noise, IsTheSameOneByOneAndTwoAtOnce) {
    for_places([](float x, float y, std::uint32_t salt) {
        const auto [coarse, fine] = two_fractal_noises(x, y, 2.3F, 9, salt);
        ASSERT_EQ(coarse, fractal_noise(x * 2.3F, y * 2.3F, 2, salt)) << x << ", " << y;
        ASSERT_EQ(fine, fractal_noise(x * 9, y * 9, 2, salt + 2)) << x << ", " << y;
    });
}

}  // namespace
}  // namespace reprise::render

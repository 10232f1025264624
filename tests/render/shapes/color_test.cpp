#include "render/shapes/color.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "render/shapes/fast_math.h"

namespace reprise::render {
namespace {

using Array = Eigen::Array3f;

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr std::array<float, 9> numbers{0, 1, -1, 0.1F, 3.7e-5F, 1e30F, -7.25F, 1e-42F, infinite};

Array read(const Color& color) {
    return {color.x(), color.y(), color.z()};
}

/// Calls `check` with colours of all the numbers, and the arrays that are to agree with them.
template <typename Check>
void for_pairs(const Check& check) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
        for (std::size_t j = 0; j < numbers.size(); ++j) {
            const auto number = [](std::size_t k) { return numbers[k % numbers.size()]; };
            const Array a{number(i), number(i + 1), number(i + 2)};
            const Array b{number(j), number(j + 3), number(j + 5)};
            check(Color(a.x(), a.y(), a.z()), Color(b.x(), b.y(), b.z()), a, b);
        }
}

void expect_same(const Color& color, const Array& array) {
    const Array own = read(color);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_TRUE(own[channel] == array[channel] ||
                    (std::isnan(own[channel]) && std::isnan(array[channel])))
            << own.transpose() << " for " << array.transpose();
        EXPECT_TRUE(color[channel] == own[channel] || std::isnan(own[channel]));
    }
}

TEST(Color, ReckonsInEachChannelAsSingleNumbersDo) {
    for_pairs([](const Color& p, const Color& q, const Array& a, const Array& b) {
        expect_same(p + q, a + b);
        expect_same(p - q, a - b);
        expect_same(p * q, a * b);
        expect_same(p / q, a / b);
        expect_same(-p, -a);
        expect_same(p + q.x(), a + b.x());
        expect_same(q.x() - p, b.x() - a);
        expect_same(p / q.y(), a / b.y());
        expect_same(mix(p, q, 0.3F), a + (b - a) * 0.3F);
        Color sum = p;
        sum += q;
        sum *= q;
        sum *= 0.7F;
        sum /= 3;
        expect_same(sum, (a + b) * b * 0.7F / 3);
        EXPECT_EQ(p == q, (a == b).all());
    });
}

TEST(Color, LeastAndMostAreThoseOfTheThree) {
    for_pairs([](const Color& p, const Color& q, const Array& a, const Array& b) {
        expect_same(p.max(q), a.max(b));
        expect_same(p.min(q), a.min(b));
        EXPECT_EQ(p.maxCoeff(), a.maxCoeff());
        EXPECT_EQ(p.minCoeff(), a.minCoeff());
        EXPECT_EQ(p.is_finite(), a.isFinite().all());
    });
}

TEST(Color, WhatIsNoNumberIsNotHiddenByBounds) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    for (int channel = 0; channel < 3; ++channel) {
        Array array{0.25F, 0.5F, 0.75F};
        array[channel] = none;
        const Color color(array.x(), array.y(), array.z());
        EXPECT_TRUE(std::isnan(color.max(0)[channel]));
        EXPECT_TRUE(std::isnan(color.min(1)[channel]));
        EXPECT_FALSE(color.is_finite());
    }
}

TEST(Color, ItsPowersOfEAreThoseOfItsChannels) {
    const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
    for (int i = -20'000; i < 20'000; ++i) {
        const float x = static_cast<float>(i) * 4.6875e-3F;
        const std::array<float, 3> powers{x, -0.37F * x, 1e-3F * x};
        const Color color = fast_exp(Color(powers[0], powers[1], powers[2]));
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(bits(color[static_cast<int>(k)]), bits(fast_exp(powers[k]))) << powers[k];
    }
    for (const float number : numbers)
        EXPECT_EQ(bits(fast_exp(Color::Constant(number)).y()), bits(fast_exp(number))) << number;
}

}  // namespace
}  // namespace reprise::render

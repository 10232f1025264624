#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#include "scripting/lua/source.h"
#include "scripting/lua/text.h"
#include "tests/scripting/stage.h"
#include "world/random.h"

namespace reprise::scripting {

namespace {

/// Any bits at all: every exponent is as likely.
double any_double(std::uint64_t item) {
    const auto half = [&](std::uint64_t place) {
        return static_cast<std::uint64_t>(world::draw(5, item, world::Purpose::scenario, place) *
                                          0x1p32);
    };
    return std::bit_cast<double>(half(0) << 32U | half(1));
}

}  // namespace

// Both are exact, so they are equal to the bit; the one of long double is the C library's.
TEST(Charged, RemainderIsTheCLibrarys) {
    for (std::uint64_t item = 0; item < 20'000; ++item) {
        const double x = any_double(2 * item);
        const double y = any_double(2 * item + 1);
        if (std::isnan(x) || std::isnan(y))
            continue;
        const double ours = std::fmod(x, y);
        const auto theirs =
            static_cast<double>(fmodl(static_cast<long double>(x), static_cast<long double>(y)));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(ours), std::bit_cast<std::uint64_t>(theirs))
            << number_text(x) << " % " << number_text(y);
    }
    EXPECT_EQ(std::fmod(-7.0, 7.0), 0);
    EXPECT_TRUE(std::signbit(std::fmod(-7.0, 7.0)));
    EXPECT_EQ(std::fmod(3.0, std::numeric_limits<double>::infinity()), 3);
    EXPECT_TRUE(std::isnan(std::fmod(3.0, 0.0)));
    EXPECT_TRUE(std::isnan(std::fmod(std::numeric_limits<double>::infinity(), 3.0)));
}

TEST(Charged, NumbersAreReadAsPrinted) {
    for (std::uint64_t item = 0; item < 5'000; ++item) {
        const double number = any_double(item);
        if (std::isfinite(number)) {
            ASSERT_EQ(std::strtod(number_text(number).c_str(), nullptr), number);
        }
    }
}

TEST(Source, AnHonestFileOf500KilobytesIsRead) {
    std::string source = "return scenario 'test' { run = function(p)\n";
    for (int i = 0; source.size() < 500'000; ++i) {
        const std::string n = std::to_string(i);
        source += "do local place_" + n + " = { x = " + n + ".25, y = -" + n +
                  ".5, name = 'place " + n + "' }\n" + "start(function() if place_" + n +
                  ".x > time() or p == " + n + " then wait(place_" + n + ".y) end end) end\n";
    }
    EXPECT_NO_THROW(check_source(source + "end }", "test.lua"));
}

TEST(Source, NamesTheLineAndIsNotFooledByTextsAndComments) {
    const std::string comment =
        "-- and or and or\n--[[ or\nor ]] local s = 'or and' .. [==[ or ]] ]==]\n";
    std::string source;
    for (int i = 0; i < 3000; ++i)
        source += comment;
    EXPECT_NO_THROW(check_source(source, "test.lua"));
    std::string many = "local a = 1\nlocal x = a";
    for (int i = 0; i < 10'001; ++i)
        many += "\nor a";
    try {
        check_source(many, "test.lua");
        ADD_FAILURE() << "10,001 of 'or' passed";
    } catch (const std::exception& error) {
        EXPECT_EQ(std::string(error.what()).rfind("test.lua:10003: more than 10,000 of", 0), 0U)
            << error.what();
    }
}

}  // namespace reprise::scripting

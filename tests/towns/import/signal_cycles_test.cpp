#include "towns/import/signal_cycles.h"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace reprise::towns {
namespace {

/// Of as many approaches, each with a green and 8 s to clear the junction; nobody knows who meets.
std::string program(int approaches, double green) {
    std::string phases;
    for (int i = 0; i < approaches; ++i) {
        std::string go(static_cast<std::size_t>(approaches), 'r'), stop = go;
        go[static_cast<std::size_t>(i)] = 'G';
        stop[static_cast<std::size_t>(i)] = 'y';
        phases += fmt::format(
            "<phase duration='{}' state='{}'/><phase duration='5' state='{}'/>"
            "<phase duration='3' state='{}'/>",
            green,
            go,
            go,
            stop);
    }
    return "<net><tlLogic id='a' type='static'>" + phases + "</tlLogic></net>";
}

int count_of(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

TEST(SignalCycles, OfMoreThanTwoMinutesGiveShorterGreens) {
    std::string network = program(8, 26);
    const ShortenedCycles shortened = shorten_cycles(network);
    EXPECT_EQ(shortened.programs, 1);
    EXPECT_EQ(shortened.longest, 8 * 34);
    EXPECT_EQ(count_of(network, "duration=\"7\""), 8) << "8 * (7 + 8) = 120";
    EXPECT_EQ(count_of(network, "duration=\"5\""), 8) << "what clears the junction stays";
    EXPECT_EQ(count_of(network, "duration=\"3\""), 8);
}

TEST(SignalCycles, LeaveEverybodySixSecondsOfGreen) {
    std::string network = program(12, 26);
    shorten_cycles(network);
    EXPECT_EQ(count_of(network, "duration=\"6\""), 12);
}

TEST(SignalCycles, OfTwoMinutesKeepEveryByte) {
    const std::string before = program(4, 22);
    std::string network = before;
    EXPECT_EQ(shorten_cycles(network).programs, 0);
    EXPECT_EQ(network, before);
}

}  // namespace
}  // namespace reprise::towns

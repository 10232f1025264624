#include "wheel/repeated_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace reprise::wheel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(KeysIn, AreLettersAndArrowsOfBothKinds) {
    EXPECT_THAT(keys_in("wasd"), ElementsAre(Key::ahead, Key::left, Key::back, Key::right));
    EXPECT_THAT(keys_in("\x1b[A\x1b[B\x1bOC\x1bOD"),
                ElementsAre(Key::ahead, Key::back, Key::right, Key::left));
    EXPECT_THAT(keys_in(" r\tp"), ElementsAre(Key::hand_brake, Key::gear, Key::sensor, Key::pause));
    EXPECT_THAT(keys_in("\x1b[1;2A"), ElementsAre(Key::ahead)) << "with shift";
}

TEST(KeysIn, EscapeAloneCtrlCAndQEnd) {
    for (const char* bytes : {"\x1b", "q", "Q", "\x03", "\x1b[Z\x1b"})
        EXPECT_THAT(keys_in(bytes), ElementsAre(Key::end)) << bytes;
}

TEST(KeysIn, WhatMeansNothingIsPassedOver) {
    EXPECT_THAT(keys_in("xyz0\r\n\x1b[3~\x1b[M\x1b["), IsEmpty());
    EXPECT_THAT(keys_in("\x1b[3~w"), ElementsAre(Key::ahead));
}

TEST(RepeatedKeys, AreHeldAsLongAsTheyRepeatAndAMomentLonger) {
    RepeatedKeys keys;
    keys.press(Key::left, 10);
    EXPECT_TRUE(keys.look(10.3).left) << "until keyboards begin to repeat";
    keys.press(Key::left, 10.33);
    EXPECT_TRUE(keys.look(10.6).left);
    EXPECT_FALSE(keys.look(11).left);
}

TEST(RepeatedKeys, APedalStaysDownWhileTheWheelIsTurned) {
    RepeatedKeys keys;
    keys.press(Key::ahead, 0);
    keys.press(Key::left, 0.5);
    const Wishes both = keys.look(0.6);
    EXPECT_TRUE(both.ahead && both.left);
    EXPECT_FALSE(keys.look(1.5).ahead);
}

TEST(RepeatedKeys, TheOtherSideLetsGoOfTheFirst) {
    RepeatedKeys keys;
    keys.press(Key::left, 0);
    keys.press(Key::right, 0.1);
    keys.press(Key::ahead, 0.1);
    keys.press(Key::back, 0.1);
    const Wishes now = keys.look(0.2);
    EXPECT_TRUE(now.right && now.back);
    EXPECT_FALSE(now.left || now.ahead);
}

TEST(RepeatedKeys, WhatIsPressedOnceIsToldOnce) {
    RepeatedKeys keys;
    keys.press(Key::gear, 0);
    keys.press(Key::gear, 0);
    keys.press(Key::end, 0);
    const Wishes first = keys.look(5);
    EXPECT_EQ(first.gear, 2U);
    EXPECT_TRUE(first.end);
    const Wishes second = keys.look(5);
    EXPECT_EQ(second.gear, 0U);
    EXPECT_FALSE(second.end);
}

}  // namespace
}  // namespace reprise::wheel

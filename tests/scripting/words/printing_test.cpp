#include <cstddef>
#include <string>

#include <gmock/gmock.h>

#include "tests/scripting/stage.h"
#include "world/check.h"

namespace reprise::scripting {

// 240 kB a tick, so no tick is beyond its own cap.
TEST(Printing, EndsARunOfMoreThan256MegabytesInItsLine) {
    test::Stage stage(
        test::running("local s = ('x'):rep(60000)\nwhile true do\nfor i = 1, 4 do print(s) end\n"
                      "wait_ticks(1) end"));
    constexpr std::size_t cap = std::size_t{256} << 20U;
    constexpr std::size_t a_tick = 240'000;
    std::size_t printed = 0;
    std::string told;
    while (told.empty() && printed <= 2 * cap) {
        stage.events.clear();  // a quarter of a gigabyte, else
        try {
            stage.step();
        } catch (const world::Error& error) {
            told = error.what();
            break;
        }
        for (const world::EventT& event : stage.events)
            printed += event.text.size();
    }
    EXPECT_EQ(told, "test.lua:3: print: more than 256 MB in one run");
    EXPECT_LE(printed, cap);
    EXPECT_GT(printed + a_tick, cap);
}

}  // namespace reprise::scripting

// What a page holds, taken out of it again as a browser does.
#include "exchange/page/replay_page.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "exchange/base64.h"
#include "exchange/page/number_column.h"
#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"

namespace reprise::test {
namespace {

using exchange::NumberColumn;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

std::string from_base64(std::string_view text) {
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        constexpr std::string_view digits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos)
            break;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        if ((count += 6) >= 8)
            bytes += static_cast<char>(bits >> (count -= 8) & 0xff);
    }
    return bytes;
}

std::string inflated(const std::string& pressed) {
    std::string bytes(1 << 22, '\0');
    uLongf size = bytes.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()),
                         &size,
                         reinterpret_cast<const Bytef*>(pressed.data()),
                         pressed.size()),
              Z_OK);
    bytes.resize(size);
    return bytes;
}

/// The JSON text that the page's data begins with.
json head_of(const std::string& html) {
    const std::string mark = "type=\"application/octet-stream\">";
    const std::size_t begin = html.find(mark) + mark.size();
    const std::string bytes = inflated(from_base64(std::string_view(html).substr(begin)));
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i)
        length |= std::size_t{static_cast<std::uint8_t>(bytes[i])} << (8 * i);
    return json::parse(bytes.substr(4, length));
}

class Page : public testing::Test {
  protected:
    std::string page(const SyntheticRun& run, exchange::PageOptions options = {}) {
        write_trace(folder_ / "a.mcap", run);
        replay::TraceReader trace(folder_ / "a.mcap");
        if (options.last == 0)
            options.last = trace.last();
        const exchange::ReplayPage made = exchange::replay_page(trace, options);
        every_ = made.every;
        return made.html;
    }

    json head(const SyntheticRun& run, exchange::PageOptions options = {}) {
        return head_of(page(run, options));
    }

    const Folder folder_;
    std::uint64_t every_ = 0;
};

/// Of the first vehicle with the second one; the run itself has it touch the ground.
std::vector<json> crashes_of(const json& head) {
    std::vector<json> crashes;
    for (const json& event : head["events"])
        if (event.value("other", 0) != 0)
            crashes.push_back(event);
    return crashes;
}

world::EventT touch(std::uint32_t actor, std::uint32_t other, double impulse) {
    world::EventT event;
    event.kind = world::EventKind::collision;
    event.actor = actor;
    event.other = other;
    event.value = impulse;
    return event;
}

TEST_F(Page, HoldsEveryTickAndActor) {
    const json head = this->head({.ticks = 150, .cars = 5});
    EXPECT_EQ(head["clocks"], json({150, 150}));
    EXPECT_EQ(head["tracks"].size(), 6U);
    EXPECT_EQ(every_, 1U);
    for (const json& track : head["tracks"])
        EXPECT_EQ(track[5], 150);
}

TEST_F(Page, OfALongRunHoldsSoManyTicksThatItStaysSmall) {
    exchange::PageOptions options;
    options.most_places = 300;  // of 150 ticks with 6 actors: every third tick
    const json head = this->head({.ticks = 150, .cars = 5}, options);
    EXPECT_EQ(every_, 3U);
    EXPECT_EQ(head["clocks"][0], 51) << "1, 4, ... 148, and the last one";
    EXPECT_THAT(head["notes"].dump(), HasSubstr("one tick in 3;"));
}

TEST_F(Page, OfATraceWithoutTicksSaysSo) {
    const json head = this->head({.ticks = 0});
    EXPECT_EQ(head["tracks"], json::array());
    EXPECT_THAT(head["notes"].dump(), HasSubstr("no tick"));
}

TEST_F(Page, HasThingsAndOpenDoors) {
    const auto change = [](world::TickDraft& draft) {
        world::PropState cone;
        cone.mutate_id(900);
        cone.mutable_position() = world::Vec3(3, 4, 0);
        cone.mutable_orientation() = world::Quat(1, 0, 0, 0);
        draft.tick.props.push_back(cone);
        draft.tick.doors.emplace_back(1.1, draft.tick.vehicles.front().id(), 2, 0, 0);
    };
    const json head = this->head({.ticks = 10, .cars = 1, .change = change});
    ASSERT_EQ(head["tracks"].size(), 3U);
    EXPECT_EQ(head["tracks"][1], json({900, 3, 0, 0, 0, 10})) << "a prop in all ten ticks";
}

TEST_F(Page, TellsWhoTouchInManyTicksAsOneCrash) {
    const auto change = [](world::TickDraft& draft) {
        const std::uint64_t tick = draft.tick.index;
        if (tick >= 40 && tick <= 60)
            draft.tick.events.push_back(touch(1, 2, tick == 45 ? 5000.0 : 100.0));
        if (tick == 50)  // the same two, said the other way round
            draft.tick.events.push_back(touch(2, 1, 10));
        if (tick == 100)  // once more, later
            draft.tick.events.push_back(touch(1, 2, 7));
    };
    const std::vector<json> crashes = crashes_of(head({.ticks = 150, .change = change}));
    ASSERT_EQ(crashes.size(), 2U);
    EXPECT_EQ(crashes[0]["tick"], 40);
    EXPECT_EQ(crashes[0]["end"], 60);
    EXPECT_THAT(crashes[0]["text"].get<std::string>(), HasSubstr("5000 N s"));
    EXPECT_EQ(crashes[1]["tick"], 100);
}

TEST_F(Page, TellsTheWorstOfACrashWhenItEnds) {
    const auto change = [](world::TickDraft& draft) {
        if (draft.tick.index == 40)
            draft.tick.events.push_back(touch(1, 2, 100));
        if (draft.tick.index == 90) {
            world::EventT end = touch(1, 2, 800);
            end.kind = world::EventKind::collision_ended;
            draft.tick.events.push_back(end);
        }
    };
    const std::vector<json> crashes = crashes_of(head({.ticks = 150, .change = change}));
    ASSERT_EQ(crashes.size(), 1U);
    EXPECT_EQ(crashes[0]["end"], 90);
    EXPECT_THAT(crashes[0]["text"].get<std::string>(), HasSubstr("800 N s"));
}

TEST_F(Page, IsClosedByNoTextOfTheTrace) {
    const std::string hostile = "</script></title><b>&\"'";
    const auto change = [&](world::TickDraft& draft) {
        world::EventT said;
        said.kind = world::EventKind::printed;
        said.text = hostile;
        draft.tick.events.push_back(said);
    };
    const std::string html = page({.ticks = 10, .change = change});
    EXPECT_THAT(html, Not(HasSubstr(hostile)));
    const json events = head_of(html)["events"];
    EXPECT_TRUE(std::any_of(events.begin(), events.end(), [&](const json& event) {
        return event["text"] == hostile;
    })) << events.dump();
    EXPECT_THAT(html, HasSubstr("default-src 'none'"));
    EXPECT_THAT(html, Not(HasSubstr("https:"))) << "nothing is fetched from anywhere";
}

/// Undoes NumberColumn, as trace.js does.
std::vector<std::int64_t> numbers_in(const std::string& bytes) {
    std::vector<std::int64_t> numbers;
    std::uint64_t value = 0;
    int shift = 0;
    for (const char c : bytes) {
        value |= std::uint64_t{static_cast<std::uint8_t>(c) & 0x7fU} << shift;
        shift += 7;
        if (static_cast<std::uint8_t>(c) < 0x80) {
            numbers.push_back(static_cast<std::int64_t>(value >> 1) ^
                              -static_cast<std::int64_t>(value & 1));
            value = 0;
            shift = 0;
        }
    }
    return numbers;
}

TEST(NumberColumn, KeepsSmallAndLargeOnes) {
    const std::vector<std::int64_t> all{
        0, 1, -1, 63, 64, -64, -65, 8191, 8192, 1 << 30, -(1 << 30), 0x7fff'ffff, -0x8000'0000LL};
    NumberColumn column;
    for (const std::int64_t one : all)
        column.append(one);
    EXPECT_EQ(numbers_in(column.bytes()), all);
}

TEST(NumberColumn, TakesNoNumbersAndFarPlacesFromHostileTraces) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(exchange::quantised(std::nan(""), 100), 0);
    EXPECT_EQ(exchange::quantised(-infinity, 100), -(1 << 28));
    EXPECT_EQ(exchange::quantised(1e300, 100), 1 << 28);
    EXPECT_EQ(exchange::quantised(-12.344, 100), -1234);
}

TEST(Base64, IsThatOfTheStandard) {
    // RFC 4648, section 10.
    EXPECT_EQ(exchange::base64(""), "");
    EXPECT_EQ(exchange::base64("f"), "Zg==");
    EXPECT_EQ(exchange::base64("foob"), "Zm9vYg==");
    EXPECT_EQ(exchange::base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace reprise::test

// Drives that do something wrong on purpose, and what `reprise score` says of them.
#include <algorithm>
#include <filesystem>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class ScoreCommand : public testing::Test {
  protected:
    /// Of the first who drives in a scenario with this body.
    Json scored(const std::string& header, const std::string& body, int code = 0) {
        write_file(folder_ / "a.lua",
                   "return scenario 'a' { " + header + ", run = function()\n" + body + "\nend }");
        const Result run = reprise({"run", "a.lua", "-o", "a.mcap"}, folder_.path());
        EXPECT_EQ(run.code, code) << run.out;
        ran_ = run.out;
        const std::string told = said({"--json"});
        const Json all = Json::parse(told, nullptr, false);
        if (all.is_discarded() || all["vehicles"].empty()) {
            ADD_FAILURE() << "no score, but: " << told << "\nof a run that said: " << run.out;
            return {};
        }
        return all["vehicles"][0];
    }

    std::string said(const std::vector<std::string>& more, int code = 0) {
        std::vector<std::string> words{"score", "a.mcap"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = reprise(words, folder_.path());
        EXPECT_EQ(result.code, code) << result.out;
        return result.out;
    }

    /// Every kind but these is not there.
    static void expect_only(const Json& vehicle, const std::vector<std::string>& kinds) {
        for (const auto& [kind, told] : vehicle["kinds"].items()) {
            const bool expected = std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
            EXPECT_EQ(told["count"] > 0, expected) << kind << " of " << vehicle.dump(2);
        }
    }

    static Json only(const Json& vehicle, const std::string& kind) {
        expect_only(vehicle, {kind});
        EXPECT_EQ(vehicle["kinds"][kind]["episodes"], 1) << vehicle["infractions"].dump(2);
        return vehicle["infractions"].empty() ? Json() : vehicle["infractions"][0];
    }

    Folder folder_;
    std::string ran_;  ///< what the last run said
};

const std::string on_junction =
    "local function at(wish)\n"
    "  local junction = pick_junction(wish)\n"
    "  for _, arm in ipairs(junction.arms) do\n"
    "    local to = lane_next(arm.incoming[1], 'straight')\n"
    "    if to and (not wish.stop or arm.stop) then return arm.incoming[1], to end\n"
    "  end\nend\n";

TEST_F(ScoreCommand, ACleanDriveToItsGoalHasAHundredPercent) {
    const Json ego = scored("town = 'junctions', duration = 60, seed = 3",
                            on_junction +
                                "local from, to = at{ lit = true, arms = 4 }\n"
                                "local ego = spawn{ name = 'ego', model = 'sedan', lane = from,\n"
                                "                   s = lane_length(from) - 60, speed_kmh = 30 }\n"
                                "ego:route_to{ lane = to, s = 30 }\n"
                                "wait_until(function() return ego:route_completion() == 1 end)\n");
    expect_only(ego, {});
    EXPECT_EQ(ego["route"]["completion"], 1);
    for (const char* leaderboard : {"leaderboard_1_2", "leaderboard_2_1"})
        EXPECT_EQ(ego[leaderboard]["score"], 100) << leaderboard;
    EXPECT_THAT(said({}),
                HasSubstr("  Leaderboard 2.1           100.0   100.0 % of the route x 1, nothing"));
    EXPECT_THAT(said({"--actor", "ego"}), HasSubstr("ego (1), sedan: "));
    EXPECT_THAT(said({"--actor", "ega"}, 2), HasSubstr("no actor 'ega' (did you mean 'ego'?)"));
}

TEST_F(ScoreCommand, ARedLightThatIsRunIsOne) {
    const Json ego = scored("town = 'junctions', duration = 12, seed = 3",
                            on_junction +
                                "local from, to = at{ lit = true, arms = 4 }\n"
                                "local ego = spawn{ name = 'ego', model = 'sedan', lane = from,\n"
                                "                   s = lane_length(from) - 40, speed_kmh = 30 }\n"
                                "ego:set_route{ from, to }\n"
                                "set_signal(from, 'red')\n"
                                "ego:ignore_lights() ego:hold_speed_kmh(30)\n"
                                "wait_until(function() return ego:ran_red() end)\n"
                                "print('red at ' .. tick())\nwait(3)\n");
    const Json light = only(ego, "red_light");
    EXPECT_NEAR(light["worst"], 30 / 3.6, 0.05);
    EXPECT_THAT(reprise({"info", "a.mcap"}, folder_.path()).out,
                HasSubstr("red at " + light["first_tick"].get<std::string>()))
        << "the tick of ego:ran_red()";
    EXPECT_THAT(ran_, HasSubstr(" s  ego ran a red light on x_")) << "and says so";
    EXPECT_THAT(ran_, HasSubstr(" at 8.3 m/s\n"));
    EXPECT_EQ(reprise({"verify", "a.mcap"}, folder_.path()).code, 0);
    EXPECT_NEAR(ego["leaderboard_1_2"]["penalty"], 0.7, 1e-12);
    EXPECT_NEAR(ego["leaderboard_2_1"]["penalty"], 1 / 1.4, 1e-12);
}

TEST_F(ScoreCommand, AStopSignIsPassedByWhoDoesNotStandAtIt) {
    const std::string start = on_junction +
                              "local from, to = at{ stop = true, arms = 4 }\n"
                              "local ego = spawn{ name = 'ego', model = 'sedan', lane = from,\n"
                              "                   s = lane_length(from) - 40, speed_kmh = 20 }\n"
                              "ego:set_route{ from, to }\n";
    const std::string header = "town = 'junctions', duration = 15, seed = 3";
    const Json past =
        only(scored(header, start + "ego:ignore_lights() ego:hold_speed_kmh(20) wait(10)\n"),
             "stop_sign");
    EXPECT_NEAR(past["worst"], 20 / 3.6, 0.05);
    EXPECT_THAT(ran_, HasSubstr(" s  ego ran a stop sign on x_"));
    // It stands far from the line, then drives on.
    only(scored(header,
                start + "ego:ignore_lights() ego:brake(4)\n"
                        "wait_until(function() return ego:speed() < 0.01 end)\n"
                        "assert(lane_length(from) - ego:s() > 10)\n"
                        "ego:hold_speed_kmh(20) wait(9)\n"),
         "stop_sign");
    // It stands at the line.
    expect_only(scored(header,
                       start + "ego:ignore_lights() ego:hold_speed_kmh(15)\n"
                               "wait_until(function() return lane_length(from) - ego:s() < 8 end)\n"
                               "ego:brake(4)\n"
                               "wait_until(function() return ego:speed() < 0.01 end)\n"
                               "ego:hold_speed_kmh(20) wait(5)\n"),
                {});
}

TEST_F(ScoreCommand, TenSecondsOnTheSidewalkCountFive) {
    const Json ego =
        scored("town = 'town1', duration = 14, seed = 2",
               "local lane = pick_lane{ length = 80, sidewalk = true, straight = true }\n"
               "local walk = lane:gsub('_%d+$', '_0')\n"
               "local function place(s) local x, y, _, h = lane_point(walk, s)\n"
               "  return { x = x, y = y, heading_deg = h } end\n"
               "local p, q = place(15), place(45)\n"
               "local ego = spawn{ name = 'ego', model = 'city_car', driver = 'manual', x = p.x, y "
               "= p.y,\n"
               "                   heading_deg = p.heading_deg }\n"
               "q.t = 10 ego:follow{ q }\n"
               "wait(9.9) ego:teleport{ lane = lane, s = 45 } wait(2)\n");
    expect_only(ego, {"sidewalk", "collision_static"});  // lamp posts stand there
    EXPECT_EQ(ego["kinds"]["sidewalk"]["episodes"], 1);
    const Json walk = ego["infractions"][0];
    ASSERT_EQ(walk["kind"], "sidewalk");
    EXPECT_GT(walk["worst"], 0.5);
    EXPECT_THAT(ran_, HasSubstr("    0.10 s  ego is over a sidewalk on "));
    EXPECT_EQ(walk["first_tick"], "1");
    EXPECT_NEAR(std::stod(walk["last_tick"].get<std::string>()), 200, 2);
    EXPECT_EQ(walk["count"], 5);
    EXPECT_NEAR(ego["kinds"]["sidewalk"]["km_between"].get<double>() * 5,
                ego["driven"].get<double>() / 1000,
                1e-9);
}

TEST_F(ScoreCommand, TheOppositeLaneCountsAndForLongItIsTheWrongWay) {
    const auto along = [&](double seconds) {
        return scored("town = 'straight', duration = 30",
                      "local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual',\n"
                      "                   lane = 'east_2', s = 100, speed = 10 }\n"
                      "local function p(t, off) local x, y = lane_point('east_2', 100 + 10 * t, "
                      "off) return { t = t, x = x, y = y } end\n"
                      "local long = " +
                          std::to_string(seconds) +
                          "\nego:follow{ p(1, 0), p(3, 3.75), p(3 + long, 3.75), p(5 + long, 0) }\n"
                          "wait(6 + long)\n");
    };
    const Json brief = only(along(2), "opposite_lane");
    EXPECT_EQ(brief["worst"], 1) << "all of it";
    const Json ego = along(10);
    expect_only(ego, {"opposite_lane", "wrong_way"});
    EXPECT_THAT(ran_, HasSubstr(" s  ego is over an opposite lane on east_2: "));
    EXPECT_THAT(ran_, HasSubstr(" s  ego drives the wrong way on east_2"));
    EXPECT_GE(ego["kinds"]["opposite_lane"]["count"], 5);
    EXPECT_GT(ego["off_lane"], 99);
    EXPECT_LT(ego["off_lane"], 130) << "100 m beside, and the most of both changes";
}

TEST_F(ScoreCommand, SpeedingIsAboveTheLimitAndWhatSpeedMetersMayBeOff) {
    const auto at = [&](double kmh) {
        return scored("town = 'town1', duration = 6, seed = 2",
                      "local lane = pick_lane{ length = 80, straight = true }\n"
                      "local limit = speed_limit(lane) * 3.6\n"
                      "local ego = spawn{ name = 'ego', model = 'sedan', lane = lane, s = 10,\n"
                      "                   speed_kmh = limit + " +
                          std::to_string(kmh) + " }\nego:hold_speed() wait(3)\n");
    };
    expect_only(at(2), {});
    const Json fast = only(at(5), "speeding");
    EXPECT_NEAR(fast["worst"], 5 / 3.6, 0.1);
    EXPECT_THAT(ran_, HasSubstr(" m/s above the limit on "));
    EXPECT_EQ(fast["count"], 2) << "three seconds";
}

TEST_F(ScoreCommand, WhoLeavesTheRoadIsOffIt) {
    const Json ego = scored("town = 'straight', duration = 8",
                            "local x, y = lane_point('east_0', 300, -12)\n"
                            "local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual',\n"
                            "                   x = x, y = y, heading_deg = 0, speed = 5 }\n"
                            "wait(4)\n");
    const Json off = only(ego, "off_road");
    EXPECT_GT(off["worst"], 1);
    EXPECT_EQ(off["first_tick"], "1");
    EXPECT_THAT(ran_, HasSubstr("    0.10 s  ego left the road"));
}

TEST_F(ScoreCommand, CollisionsHaveKinds) {
    const auto hit = [&](const std::string& what) {
        return scored("town = 'straight', duration = 6",
                      "local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s = 100,"
                      " speed_kmh = 40 }\n" +
                          what + "\nego:hold_speed_kmh(40) wait(4)\n");
    };
    const Json car =
        hit("spawn{ name = 'van', model = 'van', driver = 'parked', lane = 'east_1', "
            "s = 120 }");
    expect_only(car, {"collision_vehicle"});
    EXPECT_THAT(said({}), HasSubstr(" N s with van, at "));
    EXPECT_NEAR(car["leaderboard_2_1"]["penalty"], 1 / 1.7, 1e-12) << "touched twice, hit once";
    const Json walker = hit("spawn{ name = 'child', model = 'child', lane = 'east_1', s = 120 }");
    EXPECT_EQ(walker["kinds"]["collision_pedestrian"]["count"], 1);
    EXPECT_EQ(walker["kinds"]["collision_vehicle"]["count"], 0);
    EXPECT_NEAR(walker["leaderboard_1_2"]["penalty"], 0.5, 1e-12);
    const Json box = hit("spawn{ name = 'box', model = 'box', lane = 'east_1', s = 120 }");
    EXPECT_EQ(box["kinds"]["collision_static"]["episodes"], 1);
}

TEST_F(ScoreCommand, WhoStandsInTheWayForAMinuteIsBlocked) {
    const Json ego =
        scored("town = 'straight', duration = 75",
               "spawn{ name = 'van', model = 'van', driver = 'parked', lane = "
               "'east_1', s = 140 }\n"
               "local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s "
               "= 115, lane_changes = false }\nego:route_to{ lane = 'east_1', s = 900 }\n"
               "wait(75)\n");
    const Json blocked = only(ego, "blocked");
    EXPECT_GT(blocked["worst"], 60);
    EXPECT_LT(ego["leaderboard_1_2"]["score"], 10);
}

TEST_F(ScoreCommand, WhoHasNoMassIsNotScored) {
    scored("town = 'straight', duration = 1",
           "spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s = 10 }\n"
           "spawn{ name = 'van', model = 'van', driver = 'traffic', lane = 'east_1', s = 90 }\n"
           "wait(1)");
    EXPECT_THAT(said({"--actor", "van"}, 2), HasSubstr("only who drives with mass"));
    EXPECT_THAT(said({}), HasSubstr("it was told no route"));
    EXPECT_EQ(Json::parse(said({"--json"}))["vehicles"][0]["leaderboard_2_1"]["score"], Json());
}

TEST_F(ScoreCommand, IsAFunctionOfTheTraceAlone) {
    scored("town = 'town1', duration = 5, cars = 20",
           "spawn{ name = 'ego', model = 'sedan' } wait(5)");
    const std::string once = said({"--json"});
    const Folder empty;
    std::filesystem::copy(folder_ / "a.mcap", empty / "a.mcap");
    EXPECT_EQ(reprise({"score", "a.mcap", "--json"}, empty.path()).out, once);
}

}  // namespace
}  // namespace reprise::test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "world/check.h"
#include "world/models/catalogue.h"

// Every mistake of a scenario's author is one line that names the place and a way out.
namespace reprise::scripting {

namespace {

struct Mistake {
    const char* body;
    const char* message;
};

constexpr const char* ego =
    "local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s = 20 }\n";
constexpr const char* child = "local child = spawn{ model = 'child', lane = 'east_0', s = 20 }\n";
constexpr const char* hand =
    "local hand = spawn{ model = 'sedan', driver = 'manual', lane = 'east_1' }\n";

void expect(const char* before, const std::vector<Mistake>& table) {
    for (const auto& [body, message] : table)
        EXPECT_EQ(test::mistake(std::string(before) + body), std::string("test.lua:2: ") + message)
            << body;
}

}  // namespace

TEST(Mistakes, OfSpawn) {
    expect(
        "\n",
        {
            {"spawn{ modle = 'sedan' }", "spawn: unknown key 'modle' (did you mean 'model'?)"},
            {"spawn 'sedan'", "spawn: the argument must be a table { key = value }, got 'sedan'"},
            {"spawn{}",
             "spawn: 'model' is missing: one of sedan, hatchback, suv, van, lorry, bus, city_car, "
             "wagon, coupe, pickup, taxi, police, ambulance, minibus, motorcycle, bicycle, one of "
             "50 walkers such as adult (reprise list walkers), or one of 10 props such as cone "
             "(reprise list props)"},
            {"spawn{ model = 'sedna' }",
             "spawn: no model 'sedna' (did you mean 'sedan'?); there are sedan, hatchback, "
             "suv, van, lorry, bus, city_car, wagon, coupe, pickup, taxi, police, ambulance, "
             "minibus, motorcycle, bicycle, one of 50 walkers such as adult (reprise list "
             "walkers), "
             "or one of 10 props such as cone (reprise list props)"},
            {"spawn{ model = 'sedan', driver = 'autopilt' }",
             "spawn: no driver 'autopilt' (did you mean 'autopilot'?); there are "
             "autopilot, manual, traffic, parked, walker, external, prop"},
            {"spawn{ model = 'sedan', driver = 'walker' }",
             "spawn: a sedan cannot have the driver 'walker'"},
            {"spawn{ model = 'child', driver = 'traffic' }",
             "spawn: a child cannot have the driver 'traffic'"},
            {"spawn{ model = 'sedan', lane = 'eats_1' }",
             "spawn: no lane 'eats_1' in straight_road (did you mean 'east_1'?)"},
            {"spawn{ model = 'sedan', lane = 'east_0' }",
             "spawn: 'east_0' is a sidewalk, no lane for cars; beside it lies 'east_1' (driving)"},
            {"spawn{ model = 'sedan', lane = 'east' }",
             "spawn: 'east' is an edge of straight_road: its lanes are 'east_1' (driving), "
             "'east_2' (driving), 'east_0' (sidewalk)"},
            {"spawn{ model = 'sedan', lane = 'main' }",
             "spawn: no lane 'main' in straight_road; reprise list lanes shows them"},
            {"spawn{ model = 'sedan', lane = 'east_1', s = 401 }",
             "spawn: 's' must be in [0, 400.00], the length of 'east_1', got 401.0"},
            {"spawn{ model = 'sedan', lane = 'east_1', s = 'far' }",
             "spawn: 's' must be a number, got 'far'"},
            {"spawn{ model = 'sedan', lane = 'east_1', s = 0/0 }",
             "spawn: 's' must be a finite number, got nan"},
            {"spawn{ model = 'sedan', lane = 'east_1', s = 20, offset = 1/0 }",
             "spawn: 'offset' must be a finite number, got inf"},
            {"spawn{ model = 'sedan', lane = 'east_1', s = 20, offset = 2 }",
             "spawn: 'offset' must be in [-1.75, 1.75], half the width of 'east_1', got 2.0"},
            {"spawn{ model = 'van', driver = 'parked', lane = 'east_1', s = 20, offset = -51 }",
             "spawn: 'offset' must be in [-50.00, 50.00], got -51.0"},
            {"spawn{ model = 'sedan', speed = -1/0 }",
             "spawn: 'speed' must be a finite number, got -inf"},
            {"spawn{ model = 'sedan', speed_kmh = 1000 }",
             "spawn: the speed must be in [0, 150] m/s, got 277.77777777777777"},
            {"spawn{ model = 'sedan', s = 3 }", "spawn: 's' and 'offset' need a 'lane'"},
            {"spawn{ model = 'van', driver = 'parked' }",
             "spawn: 'lane' is missing: only who drives is given a free place"},
            {"spawn{ model = 'sedan', speed = 3, speed_kmh = 3 }",
             "spawn: give 'speed' or 'speed_kmh', not both"},
            {"spawn{ model = 'sedan', speed = -3 }",
             "spawn: the speed must not be below 0, got -3.0"},
            {"spawn{ model = 'child', lane = 'east_0', speed = 3 }",
             "spawn: 'child' starts at rest"},
            {"spawn{ name = 'a', model = 'sedan' } spawn{ name = 'a', model = 'sedan' }",
             "spawn: the name 'a' is taken"},
        });
}

TEST(Mistakes, OfWhatHasNoEffect) {
    expect(
        "\n",
        {
            {"spawn{ model = 'sedan', driver = 'traffic', lane = 'east_1', offset = 1 }",
             "spawn: 'offset' has no effect on 'sedan': driver = 'traffic' keeps to the middle of "
             "its lane; leave it out, or take driver = 'autopilot'"},
            {"spawn{ model = 'sedan', driver = 'manual', lane = 'east_1', lane_changes = false }",
             "spawn: 'lane_changes' is for driver = 'autopilot' and 'traffic': whoever else moves "
             "'sedan' changes lanes by itself"},
            {"spawn{ model = 'sedan', driver = 'manual', lane = 'east_1', pilot = 'pid' }",
             "spawn: 'pilot' is for driver = 'autopilot', which 'sedan' has not"},
            {"spawn{ model = 'sedan', driver = 'traffic', lane = 'east_1', may_overtake = true }",
             "spawn: overtaking is for driver = 'autopilot': 'sedan' is driven as 'traffic'"},
            {"spawn{ model = 'sedan', lane = 'east_1', pilot = 'pid', may_overtake = true }",
             "spawn: 'sedan' has pilot = 'pid', which overtakes nobody"},
            {"spawn{ model = 'sedan', lane = 'east_1', lane_changes = false, may_overtake = true "
             "}",
             "spawn: 'may_overtake = true' needs what 'lane_changes = false' forbids"},
            {"spawn{ model = 'sedan', lane = 'east_1', pilot = 'mpc' }",
             "spawn: no pilot 'mpc'; there are idm, pid"},
        });
    expect(
        ego,
        {
            {"ego:keep_lane('yes')", "keep_lane: takes true or false, true where it is left out"},
        });
    expect(child,
           {
               {"child:set_speed(2)",
                "set_speed: has no effect on 'child', which stands until it is told where to go: "
                "child:walk{ to = { x, y }, speed = 2 }"},
               {"child:free_speed()",
                "free_speed: has no effect on 'child', which stands until it is told where to go: "
                "child:walk{ to = { x, y }, speed = 2 }"},
               {"child:walk{ to = { 1, 2 } } child:set_speed(2, { over = 1 })",
                "set_speed: 'over' has no effect on 'child': a walker changes its speed by 2 "
                "m/s^2; leave it out, or take driver = 'traffic'"},
               {"child:keep_lane()", "keep_lane: 'child' is a walker"},
               {"child:walk_to{ x = 1, y = 2, s = 3 }", "walk_to: 's' and 'offset' need a 'lane'"},
               {"child:walk_to{ across = 'east_1', x = 3 }",
                "walk_to: needs { x, y }, { lane, s, offset } or { across = lane }"},
           });
}

TEST(Mistakes, OfActorsThatWouldStandInEachOther) {
    const std::string first =
        "local first = spawn{ name = 'first', model = 'sedan', lane = 'east_1', s = 50 } ";
    const double length = world::vehicle_models()[*world::find_vehicle_model("sedan")].length;
    for (const char* driver : {"autopilot", "manual", "traffic", "parked"})
        EXPECT_EQ(test::mistake(first + "\nspawn{ name = 'second', model = 'sedan', " +
                                "lane = 'east_1', s = " + std::to_string(50 + length - 0.5) +
                                ", driver = '" + driver + "' }"),
                  "test.lua:2: spawn: 'second' would stand in 'first', which line 1 spawned: they "
                  "reach 0.50 m into each other; move one of them by 's' or 'offset'");
    EXPECT_THAT(test::mistake(first + "wait_ticks(3)\n" +
                              "spawn{ name = 'kid', model = 'child', lane = 'east_1', s = 52 }"),
                testing::StartsWith("test.lua:2: spawn: 'kid' would stand in 'first'"));
    // Beside it, bumper to bumper, and where somebody has just left.
    EXPECT_THAT(test::printed(first + "spawn{ model = 'sedan', lane = 'east_2', s = 50 } " +
                              "spawn{ model = 'sedan', lane = 'east_1', s = " +
                              std::to_string(50 + length) + " } wait_ticks(2) first:despawn() " +
                              "spawn{ model = 'city_car', lane = 'east_1', s = 50 } print 'fine'"),
                testing::ElementsAre("fine"));
}

TEST(Mistakes, OfHandles) {
    expect(ego,
           {
               {"ego:sped()", "an actor has no 'sped' (did you mean 'speed'?)"},
               {"ego.speed()",
                "actor: an actor is needed as argument 1, got no value: write ego:speed(), "
                "gap(ego, other)"},
               {"gap(ego)",
                "gap: an actor is needed as argument 2, got no value: write ego:speed(), "
                "gap(ego, other)"},
               {"ego:change_lane('lft')",
                "no lane 'lft' in straight_road; reprise list lanes shows them"},
               {"ego:change_lane('right')", "change_lane: no lane to the right of 'east_1'"},
               {"ego:change_lane('left', { ovr = 3 })",
                "change_lane: unknown key 'ovr' (did you mean 'over'?)"},
               {"ego:change_lane('east_0')",
                "change_lane: 'east_0' is a sidewalk, no lane for cars; beside it lies 'east_1' "
                "(driving)"},
               {"ego:set_speed()", "set_speed: the speed must be a number, got nothing"},
               {"ego:set_speed(-1)", "set_speed: the speed must be in [0, 150] m/s, got -1.0"},
               {"ego:set_speed(1, { over = -1 })", "set_speed: 'over' must be in [0, 3600] s"},
               {"ego:set_route{ 'west_9' }",
                "no lane or edge 'west_9' in straight_road (did you mean 'west_1'?)"},
               {"ego:set_route{ 'east_0' }",
                "set_route: entry 1: 'east_0' is a sidewalk, no lane for cars; beside it lies "
                "'east_1' (driving)"},
               {"ego:set_route{}",
                "set_route: needs a list of lanes or edges: "
                "ego:set_route{ 'a1_b1', 'b1_b2' }"},
               {"ego:route_to{ s = 3 }",
                "route_to: needs a lane: ego:route_to{ lane = 'b1_b2_1', s = 30 }"},
               {"ego:route_to{ lane = 'east_9' }",
                "no lane 'east_9' in straight_road (did you mean 'east_1'?)"},
               {"ego:route_to{ lane = 'east_0' }",
                "route_to: 'east_0' is a sidewalk, no lane for cars; beside it lies 'east_1' "
                "(driving)"},
               {"ego:route_to{ lane = 'east_1', s = 401 }",
                "route_to: 's' must be in [0, 400.0] m, got 401"},
               {"ego:route_to{ lane = 'west_1', s = 5 }",
                "route_to: no way leads from 'east_1' to 'west_1'"},
               {"ego:walk{ to = { 1, 2 } }", "walk: 'ego' is no walker"},
               {"ego:control{}", "control: 'ego' has a driver: spawn it with driver = 'manual'"},
               {"ego:collided('car')",
                "collided: no kind 'car': 'vehicle', 'walker', 'prop', 'static' or an actor"},
               {"ego:despawn() wait_ticks(2) ego:speed()",
                "'ego' left the world in tick 2: ask ego:exists() first"},
           });
    expect(
        child,
        {
            {"child:acceleration()", "acceleration: 'child' is a walker: only vehicles have one"},
            {"child:change_lane('left')", "change_lane: 'child' is a walker"},
            {"child:walk{}", "walk: 'to' must be a point: to = { x, y }"},
            {"child:walk{ to = { 1 } }", "walk: y must be a number, got nil"},
            {"child:walk{ to = { 1, 2 }, speed = 30 }", "walk: nobody runs faster than 12 m/s"},
            {"child:walk_to{ x = 1 }",
             "walk_to: needs { x, y }, { lane, s, offset } or { across = lane }"},
        });
    expect(
        hand,
        {
            {"hand:set_speed(3)",
             "set_speed: 'sedan' is driven by hand: only 'autopilot', 'traffic' and walkers obey"},
            {"hand:control{ throttle = 2 }", "control: 'throttle' must be in [0, 1], got 2"},
            {"hand:control{ gas = 1 }",
             "control: unknown key 'gas' (known: throttle, brake, steer, hand_brake, reverse)"},
        });
}

TEST(Mistakes, OfOrdersToAnotherProgramsCar) {
    expect(
        "local other = spawn{ name = 'other', model = 'sedan', driver = 'external', "
        "lane = 'east_1', s = 50 } wait_ticks(1)\n",
        {
            {"other:set_speed(3)",
             "set_speed: 'other' is driven by another program: only 'autopilot', 'traffic' and "
             "walkers obey"},
            {"other:free_speed()",
             "free_speed: 'other' is driven by another program: only 'autopilot', 'traffic' and "
             "walkers obey"},
            {"other:change_lane('left')",
             "change_lane: 'other' is driven by another program: only 'autopilot', 'traffic' and "
             "walkers obey"},
            {"other:set_route{}",
             "set_route: needs a list of lanes or edges: ego:set_route{ 'a1_b1', 'b1_b2' }"},
            {"other:route_to{ lane = 'west_1' }",
             "route_to: no way leads from 'east_1' to 'west_1'"},
            {"other:control{}", "control: 'other' has a driver: spawn it with driver = 'manual'"},
        });
}

TEST(Mistakes, OfWaitsChecksAndPlaces) {
    expect(
        "\n",
        {
            {"wait()", "wait: the time in seconds must be a number, got nothing"},
            {"wait(-1)", "wait: the time must be in [0, 1e9] s"},
            {"wait(1/0)", "wait: the time in seconds must be a finite number, got inf"},
            {"wait_ticks(1.5)", "wait_ticks: the number of ticks must be a whole number, got 1.5"},
            {"wait_until(3)", "wait_until: the condition must be a function, got 3"},
            {"wait_until(print, { timout = 3 })",
             "wait_until: unknown key 'timout' (did you mean 'timeout'?)"},
            {"start(3)", "start: the argument must be a function, got 3"},
            {"finish(3)", "finish: the reason must be a string, got 3"},
            {"check.nevr('x', print)", "check has no 'nevr' (did you mean 'never'?)"},
            {"check.never(print)", "check.never: the name must be a string, got function"},
            {"check.never('x')",
             "check.never: the second argument must be a function, got nothing"},
            {"check.max('x', print)", "check.max: the limit must be a number, got nothing"},
            {"check.never('x', print, { within = 3 })",
             "check.never: unknown key 'within' (known: stop, optional)"},
            {"check.eventually('x', print, { within = 0 })",
             "check.eventually: 'within' must be in (0, 1e9] s"},
            {"check.never('x', print) check.never('x', print)",
             "check.never: the name 'x' is taken in line 2"},
            {"check.max('x', function() return 'a' end, 3) wait(1)",
             "check 'x': the function must return a number, got string"},
            {"check.max('x', function() return 0/0 end, 3) wait(1)",
             "check 'x': the function must return a number, got nan"},
            {"pick_lane{ lanes = 3, left = true }",
             "pick_lane: straight_road has no driving lane with left = true, lanes = "
             "3"},
            {"pick_lane{ lenght = 3 }", "pick_lane: unknown key 'lenght' (did you mean 'length'?)"},
            {"lane_length('east_3')", "no lane 'east_3' in straight_road (did you mean 'east_1'?)"},
            {"random(3)", "random: the stream's name must be a string, got 3"},
            {"random_int(3, 1)", "random_int: no numbers to choose from in [3, 1]"},
            {"set_weather 'hail'",
             "set_weather: no weather 'hail'; reprise list weathers shows them all"},
            {"local x = p.gap", "params has no 'gap'"},
            {"local t = nil; t.x = 1", "attempt to index a nil value (local 't')"},
            {"assert(false)", "assertion failed!"},
            {"error('mine')", "mine"},
            {"error()", "error with a nil instead of a message"},
            {"string.format('%d', 'x')",
             "bad argument #2 to 'format' (number expected, got string)"},
        });
}

TEST(Mistakes, InCalledFunctionsNameTheInnermostLineOfTheScript) {
    EXPECT_EQ(test::mistake("local function slow()\nwait(-1)\nend\nslow()"),
              "test.lua:2: wait: the time must be in [0, 1e9] s");
    EXPECT_EQ(test::mistake("start(function()\nwait_ticks(2)\nwait(-1)\nend)\nwait(1)"),
              "test.lua:3: wait: the time must be in [0, 1e9] s");
    EXPECT_EQ(test::mistake("check.never('x', function()\nreturn nil > 3\nend)\nwait(1)"),
              "test.lua:2: attempt to compare number with nil");
}

TEST(Mistakes, CanBeCaughtByTheScript) {
    EXPECT_EQ(
        test::printed("print(pcall(wait, -1)) print(pcall(function() spawn{ colour = 1 } end))")
            .at(1),
        "false test.lua:1: spawn: unknown key 'colour' (known: name, model, driver, pilot, "
        "latency, every, "
        "lane, s, offset, x, y, z, heading_deg, ahead_of, behind, beside, gap, speed, speed_kmh, "
        "rig, "
        "sees, lane_changes, may_overtake)");
}

TEST(Mistakes, AnActorThatNeverComesIsNamedWithTheLineOfItsSpawn) {
    const std::string source =
        test::running("\nlocal ego = spawn{ name = 'ego', model = 'sedan' }\n\nego:speed()");
    const world::EpisodeT episode = test::episode(source.c_str());
    const world::TownT town = test::straight_road();
    const world::LaneMap lanes(town);
    Scenario scenario(episode, town, lanes);
    std::string message;
    for (std::uint64_t tick = 0; tick < 200 && message.empty(); ++tick) {
        const world::SealedTick empty = test::tick_with({}, {}, {}, tick);
        world::TickDraft next;
        try {
            scenario.advance(empty.view(), next);
        } catch (const world::Error& error) {
            message = error.what();
            EXPECT_EQ(tick, 101U);
        }
    }
    EXPECT_EQ(message, "test.lua:2: spawn: 'ego' did not appear within 100 ticks");
}

}  // namespace reprise::scripting

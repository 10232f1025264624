// Whole runs over every stop in a town: the built-in driver halts at the line though nobody comes.
#include <algorithm>
#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "world/models/catalogue.h"
#include "world/town.h"

namespace reprise::test {

namespace {

/// A turning that the network itself calls a stop ('s'), or one of an all-way stop ('w').
struct Stop {
    std::string from;
    std::string to;
};

/// Of cars' lanes: those of lane 0 are sidewalks.
std::vector<Stop> stops_in(const std::string& network) {
    const std::regex connection(
        R"re(<connection from="([^":]+)" to="([^"]+)" fromLane="([1-9])" toLane="([1-9])"[^>]* state="[sw]")re");
    std::vector<Stop> stops;
    for (std::sregex_iterator each(network.begin(), network.end(), connection), end; each != end;
         ++each)
        stops.push_back(
            {(*each)[1].str() + "_" + (*each)[3].str(), (*each)[2].str() + "_" + (*each)[4].str()});
    return stops;
}

/// How a car that is alone in the town came over the end of a lane.
struct Passage {
    double slowest = 1e9;  ///< [m/s] within the last metres before it
    bool passed = false;
};

/// Of cars that drive one after another: over each of these.
std::vector<Passage> passages(const std::vector<Stop>& stops, const std::string& more) {
    constexpr double at_the_line = 3;  // [m]
    std::string body;
    for (const Stop& stop : stops)
        body += fmt::format(
            "do local ego = spawn{{ model = 'sedan', lane = '{0}', s = lane_length('{0}') - 60, "
            "speed = 10 }}\n"
            "ego:set_route{{ '{0}', '{1}' }} {2}\n"
            "wait_until(function() return ego:lane() == '{1}' end, {{ timeout = 30 }})\n"
            "ego:despawn() wait(0.1) end\n",
            stop.from,
            stop.to,
            more);
    const world::Recording recording =
        in_town("junctions", body, 31 * static_cast<double>(stops.size()));
    const world::VehicleModel& sedan = world::vehicle_models()[0];
    std::vector<Passage> found(stops.size());
    for (const KeptTick& tick : run(recording))
        for (const world::Measurement& measured : tick.recorded().view.measurements()) {
            const Stop& stop = stops.at(measured.actor() - 1);
            Passage& car = found[measured.actor() - 1];
            const std::uint32_t from = *world::find_lane(recording.town, stop.from);
            const double bumper = measured.lane_s() + sedan.length - sedan.rear_overhang;
            const double to_line = recording.town.lanes[from].length - bumper;
            if (measured.lane() == from && to_line > 0 && to_line < at_the_line)
                car.slowest = std::min(car.slowest, std::abs(measured.speed()));
            car.passed = car.passed || measured.lane() == world::find_lane(recording.town, stop.to);
        }
    return found;
}

}  // namespace

TEST(StopSigns, AreObeyedAtEveryStopOfTheTown) {
    const std::vector<Stop> stops = stops_in(in_town("junctions", "wait(1)", 1).network);
    ASSERT_EQ(stops.size(), 28U) << "six stops and all-way stops, each with two or three turnings";
    const std::vector<Passage> cars = passages(stops, "");
    for (std::size_t i = 0; i < stops.size(); ++i) {
        EXPECT_LT(cars[i].slowest, 0.1) << stops[i].from << " to " << stops[i].to;
        EXPECT_TRUE(cars[i].passed)
            << stops[i].from << " to " << stops[i].to << ": it never went on";
    }
}

TEST(StopSigns, AreNoneForOneWhoIgnoresLights) {
    const Stop stop{"x_yield_x_all_stop_1", "x_all_stop_t_all_stop_1"};
    EXPECT_GT(passages({stop}, "ego:ignore_lights()").front().slowest, 3);
}

}  // namespace reprise::test

#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"
#include "world/external/sensor.h"

namespace reprise::test {

/// One of each kind that is no camera, beside a camera; drivers say which way to go.
inline constexpr const char* measuring_rig = R"(rig = {
    { name = 'roof', kind = 'lidar', x = 1.2, z = 1.8, roll_deg = 3, attributes = { range = 60, points_per_second = 80000, returns = 2 } },
    { name = 'front', width = 60, height = 40, every = 2 },
    { name = 'labels', kind = 'semantic_lidar', x = 1.2, z = 1.8, every = 3, attributes = { range = 60, channels = 8 } },
    { name = 'nose', kind = 'radar', x = 3.7, z = 0.6, every = 2 },
    { name = 'gnss', kind = 'gnss', every = 2, attributes = { noise_lat_stddev = 1e-5, latitude = 50 } },
    { name = 'imu', kind = 'imu', x = 1.3, z = 0.5, attributes = { noise_accel_stddev_x = 0.1 } },
    { name = 'bumper', kind = 'collision', every = 7 },
    { name = 'lines', kind = 'lane_invasion', every = 7 },
    { name = 'ahead', kind = 'obstacle', x = 3.7, z = 0.6, attributes = { distance = 60 } },
}, )";

inline constexpr const char* compiled = "exec " REPRISE_LOOKING_DRIVER " ";

/// Runs of half a second (10 ticks) on a street (each renderer builds the whole scene: that of a
/// town takes twice as long) among 20 cars in the rain; who is driven comes in the third tick.
class Live : public testing::Test {
  protected:
    void scenario(const std::string& name, const std::string& more) {
        write_file(folder_ / (name + ".lua"),
                   "return scenario '" + name +
                       "' { town = 'straight', cars = 20, seed = 7, duration = 0.5, weather = "
                       "'hard_rain_sunset', run = function() wait_ticks(2) spawn{ name = 'ego', "
                       "model = 'sedan', " +
                       more + "} wait(60) end }\n");
    }

    /// Returns what was printed.
    std::string run(const std::string& name, const std::string& driver, int code = 0) {
        std::vector<std::string> words{"run", name + ".lua", "-o", name + ".mcap"};
        if (!driver.empty())
            words.insert(words.end(), {"--driver", "ego=" + driver});
        const Result result = reprise(words, folder_.path());
        EXPECT_EQ(result.code, code) << result.out;
        return result.out;
    }

    std::string make_folder(const std::string& name) {
        std::filesystem::create_directory(folder_ / name);
        return folder_ / name;
    }

    /// The names of the frames that a driver kept.
    std::vector<std::string> kept(const std::string& name) {
        std::vector<std::string> names;
        for (const auto& file : std::filesystem::directory_iterator(folder_ / name))
            names.push_back(file.path().stem());
        std::sort(names.begin(), names.end());
        return names;
    }

    std::string kept_frame(const std::string& name, const world::SensorFrame& frame) {
        return read_file(folder_ / fmt::format("{}/{}_{}.raw", name, frame.name, frame.tick));
    }

    Folder folder_;
};

}  // namespace reprise::test

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "replay/trace_reader.h"
#include "tests/cli/live/live.h"

namespace reprise::test {
namespace {

const std::vector<std::string> point_sensors{"roof", "labels", "nose"};
const std::vector<std::string> table_sensors{"gnss", "imu", "bumper", "lines", "ahead"};

constexpr const char* measuring =
    "PYTHONPATH=" REPRISE_SOURCE "/python /usr/bin/python3 -B " REPRISE_SOURCE
    "/tests/cli/live/measuring_driver.py ";

class LiveMeasures : public Live {
  protected:
    /// A car that swerves into one that stands in its way, three seconds long.
    void crash(const std::string& name, const std::string& more) {
        write_file(folder_ / (name + ".lua"),
                   "return scenario '" + name +
                       "' { town = 'straight', seed = 7, duration = 3, weather = "
                       "'hard_rain_sunset', run = function() wait_ticks(2) local ego = spawn{ "
                       "name = 'ego', model = 'sedan', speed = 10, " +
                       more +
                       "} spawn{ name = 'there', model = 'van', driver = 'parked', ahead_of = "
                       "ego, gap = 9 } wait(60) end }\n");
    }

    /// What `reprise render` writes of a trace: of points the bytes of a frame, of tables the rows
    /// of a tick, as text.
    void expect_measured_again(const std::string& name, const std::string& frames) {
        const std::string again = name + "_again";
        for (const char* points : {"npy", "ply"}) {
            const Result rendered = reprise(
                {"render", name + ".mcap", "-o", again, "--points", points}, folder_.path());
            ASSERT_EQ(rendered.code, 0) << rendered.out;
        }
        const std::uint64_t last = replay::TraceReader(folder_ / (name + ".mcap")).last();
        std::map<std::string, std::size_t> rows;
        for (std::uint64_t tick = 3; tick < last; ++tick) {
            for (const std::string& sensor : point_sensors) {
                const std::string kept = fmt::format("{}/{}_{}.raw", frames, sensor, tick);
                const std::string ply = fmt::format("{}/{}/{:06}.ply", again, sensor, tick);
                ASSERT_EQ(std::filesystem::exists(folder_ / kept),
                          std::filesystem::exists(folder_ / ply))
                    << kept;
                if (!std::filesystem::exists(folder_ / ply))
                    continue;
                const std::string bytes = read_file(folder_ / kept);
                const std::string file = read_file(folder_ / ply);
                ASSERT_NE(file.find("end_header\n"), std::string::npos);
                // Of a radar's points the file says x, y, z before them.
                if (sensor == "nose")
                    rows[sensor] += bytes.size();
                else
                    EXPECT_TRUE(file.substr(file.find("end_header\n") + 11) == bytes) << ply;
                rows[sensor] += bytes.size();
            }
        }
        for (const std::string& sensor : table_sensors)
            rows[sensor] =
                compare_table(again + "/" + sensor + ".csv", frames + "/" + sensor + "_", last);
        for (const auto& [sensor, count] : rows)
            EXPECT_GT(count, 0U) << sensor << " measured nothing: the test shows nothing of it";
    }

    /// Rows of a table and of what was kept tick by tick; how many there are.
    std::size_t compare_table(const std::string& table,
                              const std::string& kept,
                              std::uint64_t last) {
        std::istringstream lines(read_file(folder_ / table));
        std::string line;
        std::getline(lines, line);
        std::vector<std::vector<double>> written;
        while (std::getline(lines, line))
            written.push_back(numbers(line, ','));
        std::vector<std::vector<double>> shown;
        for (std::uint64_t tick = 3; tick < last; ++tick) {
            std::istringstream rows(read_file(folder_ / (kept + std::to_string(tick) + ".txt")));
            std::getline(rows, line);
            while (std::getline(rows, line)) {
                shown.push_back({static_cast<double>(tick), static_cast<double>(tick) * 0.05});
                const auto values = numbers(line, ' ');
                shown.back().insert(shown.back().end(), values.begin(), values.end());
            }
        }
        std::erase_if(written, [&](const auto& row) {
            return row.empty() || row.front() >= static_cast<double>(last);
        });
        EXPECT_EQ(written, shown) << table;
        return shown.size();
    }

    static std::vector<double> numbers(const std::string& line, char between) {
        std::vector<double> found;
        std::istringstream words(line);
        std::string word;
        while (std::getline(words, word, between))
            found.push_back(std::stod(word));
        return found;
    }
};

TEST_F(LiveMeasures, WhatSensorsMeasureIsWhatTheTraceGivesAfterwards) {
    crash("measured", std::string(measuring_rig) + "driver = 'external' ");
    run("measured", measuring + make_folder("frames"));
    expect_measured_again("measured", "frames");
}

/// Through a port points go along in the message; a late driver is shown those of its own ticks.
TEST_F(LiveMeasures, PointsAreTheSameThroughAPortInCppAndForALateDriver) {
    const std::string said = std::string(measuring_rig) + "driver = 'external', ";
    crash("near", said);
    run("near", compiled + make_folder("near"));
    crash("late", said + "latency = 3 ");
    run("late", compiled + make_folder("late"));
    crash("near", said);
    make_folder("port");
    const Result result = typed(
        "reprise run near.lua --driver ego=tcp:0 -o port.mcap 2>said & run=$!; until "
        "port=$(sed -n 's/.*may come to 127.0.0.1://p' said 2>/dev/null | grep .); do kill "
        "-0 $run || exit 9; done; REPRISE_DRIVER=127.0.0.1:$port " REPRISE_LOOKING_DRIVER
        " port; wait $run",
        folder_);
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_TRUE(read_file(folder_ / "near.mcap") == read_file(folder_ / "port.mcap"));
    const std::vector<std::string> names = kept("near");
    EXPECT_EQ(names, kept("port"));
    for (const std::string& name : names)
        EXPECT_TRUE(read_file(folder_ / ("near/" + name + ".raw")) ==
                    read_file(folder_ / ("port/" + name + ".raw")))
            << name;
    const Result rendered = reprise({"render", "late.mcap", "-o", "late_again"}, folder_.path());
    EXPECT_EQ(rendered.code, 0) << rendered.out;
    for (std::uint64_t tick = 3; tick < 20; ++tick) {
        const std::string file =
            read_file(folder_ / fmt::format("late_again/roof/{:06}.ply", tick));
        EXPECT_TRUE(file.substr(file.find("end_header\n") + 11) ==
                    read_file(folder_ / fmt::format("late/roof_{}.raw", tick)))
            << tick;
    }
}

/// Of ticks that its driver is not shown, too.
TEST_F(LiveMeasures, WhatHappensIsToldWhoIsShownEachFewTicks) {
    crash("few",
          "rig = { { name = 'bumper', kind = 'collision' }, { name = 'roof', kind = 'lidar', z = "
          "1.8, attributes = { channels = 4, range = 20 } } }, driver = 'external', every = 7 ");
    run("few", measuring + make_folder("few"));
    const Result rendered = reprise({"render", "few.mcap", "-o", "again"}, folder_.path());
    ASSERT_EQ(rendered.code, 0) << rendered.out;
    std::vector<std::vector<double>> shown;
    std::uint64_t last = 0;
    for (std::uint64_t tick = 3; tick < 60; tick += 7) {
        const std::string roof = fmt::format("again/roof/{:06}.ply", tick);
        EXPECT_TRUE(std::filesystem::exists(folder_ / roof)) << "as often as its driver";
        std::istringstream lines(read_file(folder_ / fmt::format("few/bumper_{}.txt", tick)));
        std::string line;
        std::getline(lines, line);
        while (std::getline(lines, line))
            shown.push_back(numbers(line, ' '));
        last = tick;
    }
    std::vector<std::vector<double>> written;
    std::set<std::uint64_t> ticks;
    std::istringstream lines(read_file(folder_ / "again/bumper.csv"));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::vector<double> row = numbers(line, ',');
        if (row.empty() || row[0] > static_cast<double>(last))
            continue;
        ticks.insert(static_cast<std::uint64_t>(row[0]));
        written.emplace_back(row.begin() + 2, row.end());
    }
    EXPECT_EQ(shown, written);
    EXPECT_TRUE(std::any_of(ticks.begin(), ticks.end(), [](auto tick) { return tick % 7 != 3; }))
        << "it hit something in a tick that was shown: the test shows nothing";
}

/// Some look at the tick before: who takes over in the middle has seen it.
TEST_F(LiveMeasures, WhoTakesOverMeasuresWhatTheNewTraceGives) {
    crash("first", std::string(measuring_rig) + "driver = 'external' ");
    run("first", compiled + make_folder("ignored"));
    const Result branched = reprise({"branch",
                                     "first.mcap",
                                     "--at",
                                     "10t",
                                     "--driver",
                                     "ego=" + (measuring + make_folder("other")),
                                     "-o",
                                     "other.mcap"},
                                    folder_.path());
    ASSERT_EQ(branched.code, 0) << branched.out;
    const Result rendered = reprise({"render", "other.mcap", "-o", "again"}, folder_.path());
    ASSERT_EQ(rendered.code, 0) << rendered.out;
    for (const std::string sensor : {"imu", "lines", "gnss"}) {
        std::istringstream lines(read_file(folder_ / ("again/" + sensor + ".csv")));
        std::map<std::uint64_t, std::vector<double>> written;
        for (std::string line; std::getline(lines, line);)
            if (line[0] != 't')
                written[std::stoul(line)] = numbers(line, ',');
        for (std::uint64_t tick = 10; tick < 14; ++tick) {
            std::istringstream rows(
                read_file(folder_ / fmt::format("other/{}_{}.txt", sensor, tick)));
            std::string line;
            std::getline(rows, line);
            while (std::getline(rows, line)) {
                ASSERT_EQ(written.count(tick), 1U);
                const std::vector<double> row(written[tick].begin() + 2, written[tick].end());
                EXPECT_EQ(row, numbers(line, ' ')) << sensor << " at " << tick;
            }
        }
    }
}

}  // namespace
}  // namespace reprise::test

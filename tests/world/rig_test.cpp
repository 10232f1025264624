#include "world/external/rig.h"

#include <gtest/gtest.h>

#include "world/check.h"
#include "world/external/sensor_attributes.h"

namespace reprise::world {
namespace {

SensorT possible() {
    SensorT sensor;
    sensor.name = "front";
    sensor.width = 84;
    sensor.height = 60;
    sensor.fov = 1.5;
    sensor.every = 3;
    return sensor;
}

std::unique_ptr<SensorAttributeT> said(const std::string& name, double value) {
    auto attribute = std::make_unique<SensorAttributeT>();
    attribute->name = name;
    attribute->value = value;
    return attribute;
}

Rig read(const std::vector<SensorT>& sensors, std::uint64_t tick = 5) {
    CommandT command;
    command.kind = CommandKind::spawn;
    command.actor = 7;
    for (const SensorT& sensor : sensors)
        command.rig.push_back(std::make_unique<SensorT>(sensor));
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(Command::Pack(builder, &command));
    return rig_of(*flatbuffers::GetRoot<Command>(builder.GetBufferPointer()), tick);
}

TEST(Rig, LooksInTheTickOfItsSpawnAndInEachSoManyBehindIt) {
    const Rig rig = read({possible()}, 5);
    EXPECT_EQ(rig.sensors.front().actor, 7U);
    std::vector<std::uint64_t> ticks;
    for (std::uint64_t tick = 1; tick < 15; ++tick)
        if (!rig.due(tick).empty())
            ticks.push_back(tick);
    EXPECT_EQ(ticks, (std::vector<std::uint64_t>{5, 8, 11, 14}));
}

TEST(Rig, CountsTheFramesThatItMade) {
    const Rig rig = read({possible()}, 5);
    std::uint64_t made = 0;
    for (std::uint64_t tick = 5; tick < 40; ++tick) {
        EXPECT_EQ(rig.frames_before(0, tick), made) << tick;
        made += rig.is_due(0, tick) ? 1 : 0;
    }
}

TEST(Rig, KnowsWhatItsSensorsWereToldOfTheirOwn) {
    SensorT sensor = possible();
    EXPECT_EQ(attribute(read({sensor}).sensors.front(), "own_car"), 0);
    sensor.attributes.push_back(said("own_car", 1));
    sensor.roll = 0.5;
    const Rig rig = read({sensor});
    EXPECT_EQ(attribute(rig.sensors.front(), "own_car"), 1);
    EXPECT_EQ(rig.sensors.front().roll, 0.5);
}

TEST(Rig, KnowsTheSizeOfItsPictures) {
    SensorSpec sensor;
    sensor.width = 5;
    sensor.height = 7;
    for (const auto& [kind, bytes] : {std::pair{SensorKind::rgb, 105U},
                                      std::pair{SensorKind::depth, 140U},
                                      std::pair{SensorKind::semantic, 35U},
                                      std::pair{SensorKind::instance, 70U},
                                      std::pair{SensorKind::flow, 280U},
                                      std::pair{SensorKind::normals, 420U},
                                      std::pair{SensorKind::dvs, 70U}}) {
        sensor.kind = kind;
        EXPECT_EQ(picture_bytes(sensor), bytes);
    }
}

TEST(Rig, OfAForgedTraceIsRefusedBeforeAnythingIsRendered) {
    const std::vector<std::function<void(SensorT&)>> forgeries{
        [](SensorT& one) { one.name = ""; },
        [](SensorT& one) { one.name = "../../etc"; },
        [](SensorT& one) { one.name = std::string(41, 'x'); },
        [](SensorT& one) { one.width = 0; },
        [](SensorT& one) { one.height = 4097; },
        [](SensorT& one) { one.fov = 0; },
        [](SensorT& one) { one.fov = std::numeric_limits<double>::quiet_NaN(); },
        [](SensorT& one) { one.every = 0; },
        [](SensorT& one) { one.kind = static_cast<SensorKind>(9); },
        [](SensorT& one) {
            one.position = {0, std::numeric_limits<double>::infinity(), 0};
        },
        [](SensorT& one) { one.pitch = 1e300; },
        [](SensorT& one) { one.roll = 1e300; },
        [](SensorT& one) { one.attributes.push_back(said("own_cat", 1)); },
        [](SensorT& one) { one.attributes.push_back(said("own_car", 2)); },
        [](SensorT& one) {
            one.attributes.push_back(said("own_car", std::numeric_limits<double>::quiet_NaN()));
        },
        [](SensorT& one) {
            one.attributes.push_back(said("own_car", 1));
            one.attributes.push_back(said("own_car", 1));
        },
    };
    EXPECT_NO_THROW(read({possible()}));
    for (std::size_t i = 0; i < forgeries.size(); ++i) {
        SensorT sensor = possible();
        forgeries[i](sensor);
        EXPECT_THROW(read({sensor}), Error) << i;
    }
    EXPECT_THROW(read({possible(), possible()}), Error) << "two of one name";
    EXPECT_THROW(read(std::vector<SensorT>(17, possible())), Error);
}

}  // namespace
}  // namespace reprise::world

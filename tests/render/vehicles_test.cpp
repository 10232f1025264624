#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "render/look/car_surface_point.h"
#include "render/shapes/cars/car_parts.h"
#include "render/shapes/cars/two_wheeler.h"
#include "render/shapes/paint.h"
#include "tests/render/frames.h"
#include "world/models/catalogue.h"

namespace reprise {
namespace {

using test::camera;
using test::car_at;
using world::SemanticClass;
using world::SensorKind;

/// Sums of red over the pictures from behind and from ahead of a standing model.
struct Glow {
    double behind;
    double ahead;
};

Glow glow_of(render::Sensors& sensors, std::uint16_t model, int lamps, std::uint64_t tick) {
    world::CarState car = car_at(7, 120, -1.75);
    car.mutate_model(model);
    car.mutate_lamps(static_cast<std::uint16_t>(lamps));
    const world::SealedTick sealed = test::tick_with({}, {car}, {}, tick);
    const world::VehicleModel& m = world::vehicle_models()[model];
    const double back = 120 - m.rear_overhang - 4.5;
    const double front = 120 + m.length - m.rear_overhang + 4.5;
    world::SensorSpec behind = camera(SensorKind::rgb, {back, -1.75, 1.1});
    world::SensorSpec ahead = camera(SensorKind::rgb, {front, -1.75, 1.1});
    ahead.yaw = 3.14159265;
    for (world::SensorSpec* spec : {&behind, &ahead})
        spec->fov = 0.9;
    const auto frames = sensors.observe(sealed.view(), {behind, ahead}, test::noon());
    return {test::mean(frames[0], 0, 0, 0, 159, 119), test::mean(frames[1], 0, 0, 0, 159, 119)};
}

TEST(Vehicles, LampsLightWhereTheyBelong) {
    render::Sensors sensors(test::straight_road(400));
    std::uint64_t lit = 40;
    while (!render::flashes_now(lit, 7))
        ++lit;
    std::uint64_t dark = lit;
    while (render::flashes_now(dark, 7))
        ++dark;
    for (std::uint16_t model = 0; model < world::vehicle_models().size(); ++model) {
        const world::VehicleModel& m = world::vehicle_models()[model];
        SCOPED_TRACE(m.name);
        const bool bicycle = m.body == world::BodyStyle::bicycle;
        const Glow none = glow_of(sensors, model, 0, lit);
        EXPECT_GT(glow_of(sensors, model, world::lamp_brake, lit).behind, none.behind + 0.02);
        EXPECT_GT(glow_of(sensors, model, world::lamp_low_beam, lit).ahead, none.ahead + 0.02);
        if (bicycle)
            continue;  // arms, not lamps
        EXPECT_GT(glow_of(sensors, model, world::lamp_left, lit).ahead, none.ahead + 0.004);
        EXPECT_GT(glow_of(sensors, model, world::lamp_right, lit).behind, none.behind + 0.004);
        EXPECT_EQ(glow_of(sensors, model, world::lamp_right, dark).behind,
                  glow_of(sensors, model, 0, dark).behind);
    }
}

TEST(Vehicles, IndicatorsFlashThreeTimesInTwoSeconds) {
    int starts = 0;
    for (std::uint64_t tick = 1; tick <= 400; ++tick)  // 20 s
        starts += render::flashes_now(tick, 7) && !render::flashes_now(tick - 1, 7) ? 1 : 0;
    EXPECT_EQ(starts, 30);
}

TEST(Vehicles, IndicatorsOfDifferentVehiclesFlashAtDifferentInstants) {
    for (std::uint64_t tick = 0; tick < 40; ++tick) {
        int lit = 0;
        for (std::uint32_t actor = 1; actor <= 200; ++actor)
            lit += render::flashes_now(tick, actor) ? 1 : 0;
        // 22 of 40, give or take four deviations of a draw.
        EXPECT_NEAR(lit, 110, 28) << "tick " << tick;
    }
}

/// Mean x of the pixels of a plate's blue strip; the picture's right border where there is none.
double strip_in(const world::SensorFrame& frame, std::size_t width) {
    double sum = 0;
    double blues = 0;
    for (std::size_t i = 0; i + 2 < frame.data.size(); i += 3) {
        const int red = frame.data[i];
        const int green = frame.data[i + 1];
        const int blue = frame.data[i + 2];
        if (blue > 40 && blue > 3 * red && 2 * blue > 3 * green) {
            sum += static_cast<double>(i / 3 % width);
            ++blues;
        }
    }
    return blues > 0 ? sum / blues : static_cast<double>(width);
}

TEST(Vehicles, PlatesAreReadFromLeftToRightAtBothEnds) {
    render::Sensors sensors(test::straight_road(400));
    const std::uint16_t model = *world::find_vehicle_model("sedan");
    world::CarState car = car_at(7, 120, -1.75);
    car.mutate_model(model);
    const world::SealedTick tick = test::tick_with({}, {car});
    const world::VehicleModel& m = world::vehicle_models()[model];
    const double h = m.height;
    // So near and narrow that a plate fills the picture.
    world::SensorSpec behind = camera(SensorKind::rgb, {118.6 - m.rear_overhang, -1.75, 0.36 * h});
    world::SensorSpec ahead =
        camera(SensorKind::rgb, {121.4 + m.length - m.rear_overhang, -1.75, 0.26 * h});
    ahead.yaw = 3.14159265;
    for (world::SensorSpec* spec : {&behind, &ahead})
        spec->fov = 0.42;
    const auto frames = sensors.observe(tick.view(), {behind, ahead}, test::noon());
    for (const auto& frame : frames)
        EXPECT_LT(strip_in(frame, static_cast<std::size_t>(behind.width)), 0.2 * behind.width);
}

TEST(Vehicles, EachModelHasTheClassOfItsKind) {
    render::Sensors sensors(test::straight_road(400));
    for (const auto& [name, expected, rider] :
         {std::tuple{"motorcycle", SemanticClass::motorcycle, true},
          {"bicycle", SemanticClass::bicycle, true},
          {"ambulance", SemanticClass::car, false},
          {"pickup", SemanticClass::car, false}}) {
        world::CarState car = car_at(7, 110, -1.75);
        car.mutate_model(*world::find_vehicle_model(name));
        const world::SealedTick tick = test::tick_with({}, {car});
        const auto frames = sensors.observe(
            tick.view(), {camera(SensorKind::semantic, {105, -1.75, 1.0})}, test::noon());
        std::set<SemanticClass> seen;
        for (const std::uint8_t pixel : frames[0].data)
            seen.insert(static_cast<SemanticClass>(pixel));
        EXPECT_TRUE(seen.contains(expected)) << name;
        EXPECT_EQ(seen.contains(SemanticClass::rider), rider) << name;
    }
}

TEST(Vehicles, PaintIsThatOfTheLookAndTheKind) {
    const auto models = world::vehicle_models();
    const world::VehicleModel& sedan = models[*world::find_vehicle_model("sedan")];
    const world::VehicleModel& taxi = models[*world::find_vehicle_model("taxi")];
    std::set<std::tuple<float, float, float>> sedans;
    std::set<std::tuple<float, float, float>> taxis;
    const auto note = [](auto& colors, const render::Color& color) {
        colors.emplace(color.x(), color.y(), color.z());
    };
    for (std::uint32_t look = 1; look < 500; ++look) {
        note(sedans, render::paint_of(sedan, look).body);
        note(taxis, render::paint_of(taxi, look).body);
    }
    EXPECT_EQ(sedans.size(), 15U);
    EXPECT_EQ(taxis.size(), 3U);
}

TEST(Vehicles, WheelsTouchTheGroundAndNothingElseDoes) {
    for (const world::VehicleModel& model : world::vehicle_models()) {
        const render::CarShape shape(model);
        const bool thin = world::is_two_wheeler(model.body);
        const render::Mesh wheel = thin ? thin_wheel_mesh(shape) : wheel_mesh(shape);
        const auto radius = static_cast<float>(model.wheel_radius);
        float lowest = 0;
        for (const Eigen::Vector3f& vertex : wheel.vertices)
            lowest = std::min(lowest, vertex.z());
        EXPECT_NEAR(lowest, -radius, 0.004) << model.name;
        const render::Mesh body = thin ? two_wheeler_mesh(shape) : car_body_mesh(shape);
        for (const Eigen::Vector3f& vertex : body.vertices)
            EXPECT_GT(vertex.z(), 0.08) << model.name;
    }
}

/// Which part of a mesh each triangle belongs to: those that share a corner's place.
std::vector<std::size_t> parts_of(const render::Mesh& mesh) {
    std::vector<std::size_t> group(mesh.triangles.size());
    std::map<std::tuple<float, float, float>, std::size_t> first;
    const auto root = [&](std::size_t i) {
        while (group[i] != i)
            i = group[i];
        return i;
    };
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        group[i] = i;
        for (const std::uint32_t corner : mesh.triangles[i]) {
            const Eigen::Vector3f& p = mesh.vertices[corner];
            const std::size_t met = root(first.try_emplace({p.x(), p.y(), p.z()}, i).first->second);
            const std::size_t mine = root(i);
            group[std::max(met, mine)] = std::min(met, mine);
        }
    }
    for (std::size_t i = 0; i < group.size(); ++i)
        group[i] = root(i);
    return group;
}

/// Does a side of the first triangle go through the second one? (Moeller and Trumbore, 1997.)
bool pierces(const render::Mesh& mesh, std::size_t first, std::size_t second) {
    const auto& corners = mesh.triangles[second];
    const Eigen::Vector3f& a = mesh.vertices[corners[0]];
    const Eigen::Vector3f u = mesh.vertices[corners[1]] - a;
    const Eigen::Vector3f v = mesh.vertices[corners[2]] - a;
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector3f& from = mesh.vertices[mesh.triangles[first][i]];
        const Eigen::Vector3f way = mesh.vertices[mesh.triangles[first][(i + 1) % 3]] - from;
        const Eigen::Vector3f p = way.cross(v);
        const float det = u.dot(p);
        const Eigen::Vector3f t = (from - a) / det;
        const float s = t.dot(p);
        const float r = way.dot(t.cross(u));
        const float at = v.dot(t.cross(u));
        if (s >= 0 && r >= 0 && s + r <= 1 && at >= 0 && at <= 1)
            return true;
    }
    return false;
}

Eigen::AlignedBox3f box_of(const render::Mesh& mesh, std::size_t triangle) {
    Eigen::AlignedBox3f box;
    for (const std::uint32_t corner : mesh.triangles[triangle])
        box.extend(mesh.vertices[corner]);
    return box;
}

/// How many parts reach through no other one: they float before the body, or are sunk in it.
int loose_parts(const render::Mesh& mesh) {
    const std::vector<std::size_t> part = parts_of(mesh);
    std::set<std::size_t> loose(part.begin(), part.end());
    std::vector<Eigen::AlignedBox3f> boxes;
    for (std::size_t i = 0; i < part.size(); ++i)
        boxes.push_back(box_of(mesh, i));
    for (std::size_t i = 0; i < part.size(); ++i)
        for (std::size_t j = 0; j < part.size(); ++j)
            if (part[i] != part[j] && (loose.contains(part[i]) || loose.contains(part[j])) &&
                boxes[i].intersects(boxes[j]) && pierces(mesh, i, j)) {
                loose.erase(part[i]);
                loose.erase(part[j]);
            }
    return static_cast<int>(loose.size());
}

TEST(Vehicles, EveryPartHoldsOnToAnother) {
    for (const world::VehicleModel& model : world::vehicle_models()) {
        const render::CarShape shape(model);
        EXPECT_EQ(loose_parts(world::is_two_wheeler(model.body) ? two_wheeler_mesh(shape)
                                                                : car_body_mesh(shape)),
                  0)
            << model.name;
    }
}

/// Red paint above the band, seen from this side of an ambulance. [pixels]
int red_letters(render::Sensors& sensors, double side) {
    world::CarState car = car_at(7, 120, 0);
    car.mutate_model(*world::find_vehicle_model("ambulance"));
    world::SensorSpec spec = camera(SensorKind::rgb, {120.9, side * 6, 1.8});
    spec.yaw = -side * 1.5707963;
    spec.fov = 0.6;
    spec.width = 480;
    spec.height = 240;
    const auto frames = sensors.observe(test::tick_with({}, {car}).view(), {spec}, test::noon());
    int red = 0;
    for (std::size_t i = 0; i + 2 < frames[0].data.size() / 2; i += 3)
        red += frames[0].data[i] > 2.2 * frames[0].data[i + 1] ? 1 : 0;
    return red;
}

TEST(Vehicles, AmbulanceIsWrittenInFullOnBothSides) {
    render::Sensors sensors(test::straight_road(400));
    const int left = red_letters(sensors, 1);
    EXPECT_GT(left, 100);
    EXPECT_NEAR(left, red_letters(sensors, -1), 0.02 * left);
}

}  // namespace
}  // namespace reprise

// Renders everything that stands in a town, for people to look at. usage: gallery FOLDER [WEATHER]
#include <cstdio>
#include <string>

#include "render/picture.h"
#include "render/sensors.h"
#include "tests/render/everything.h"
#include "tests/render/street.h"

namespace {

using namespace reprise;

struct View {
    const char* name;
    Eigen::Vector3d position;
    double yaw;
    double pitch;
};

void shoot(render::Sensors& sensors,
           const View& view,
           const world::Weather& weather,
           const std::string& folder) {
    world::SensorSpec spec = test::camera(world::SensorKind::rgb, view.position);
    spec.width = 960;
    spec.height = 600;
    spec.yaw = view.yaw;
    spec.pitch = view.pitch;
    spec.fov = 1.25;
    const world::SealedTick tick = test::street_tick();
    render::write_png(sensors.observe(tick.view(), {spec}, weather)[0],
                      folder + "/" + view.name + ".png");
}

}  // namespace

int main(int argc, char** argv) {
    const std::string folder = argc > 1 ? argv[1] : ".";
    const world::Weather& weather = argc > 2 ? world::find_weather(argv[2])->weather : test::noon();
    world::TownT row = test::straight_road_with_signal(620);
    row.buildings = test::all_buildings();
    render::Sensors buildings(row);
    for (int i = 0; i < 10; ++i) {
        const world::Building& left = row.buildings[static_cast<std::size_t>(4 * i)];
        const world::Building& right = row.buildings[static_cast<std::size_t>(4 * i + 1)];
        const std::string number = std::to_string(i);
        shoot(buildings,
              {("left" + number).c_str(), {left.centre().x() - 22, -9, 2.2}, 0.75, 0.17},
              weather,
              folder);
        shoot(buildings,
              {("right" + number).c_str(), {right.centre().x() - 22, 9, 2.2}, -0.75, 0.17},
              weather,
              folder);
    }
    shoot(buildings, {"street_a", {8, -1.7, 1.5}, 0, 0.05}, weather, folder);
    shoot(buildings, {"street_b", {150, -1.7, 1.5}, 0, 0.05}, weather, folder);
    shoot(buildings, {"street_c", {330, -1.7, 1.5}, 3.14, 0.05}, weather, folder);
    shoot(buildings, {"street_d", {480, -1.7, 1.5}, 3.14, 0.05}, weather, folder);
    shoot(buildings, {"close_a", {40, 4, 1.6}, 1.3, 0.05}, weather, folder);
    shoot(buildings, {"close_b", {300, 5, 1.6}, 0.7, 0.1}, weather, folder);
    shoot(buildings, {"roofs", {60, -60, 60}, 0.6, -0.5}, weather, folder);

    world::TownT things = test::straight_road_with_signal(200);
    things.trees = test::all_plants();
    things.props = test::all_props();
    things.plots = {test::plot(world::PlotKind::lawn, 12, 12, 26, 26),
                    test::plot(world::PlotKind::park, 28, 12, 52, 36),
                    test::plot(world::PlotKind::square, 54, 12, 74, 30),
                    test::plot(world::PlotKind::gravel, 76, 12, 86, 24),
                    test::plot(world::PlotKind::water, 12, -40, 32, -14),
                    test::plot(world::PlotKind::car_park, 34, -44, 60, -12),
                    test::plot(world::PlotKind::playground, 62, -30, 76, -12),
                    test::plot(world::PlotKind::forest, 78, -36, 100, -12)};
    render::Sensors sensors(things);
    shoot(sensors, {"plants_a", {30, -4, 1.6}, 1.57, 0.12}, weather, folder);
    shoot(sensors, {"plants_b", {62, -4, 1.6}, 1.57, 0.12}, weather, folder);
    shoot(sensors, {"plants_c", {86, 0, 1.6}, 1.4, 0.05}, weather, folder);
    for (int i = 0; i < 5; ++i)
        shoot(sensors,
              {("props" + std::to_string(i)).c_str(), {14.0 + 17 * i, -2.5, 1.6}, -0.75, 0.0},
              weather,
              folder);
    shoot(sensors, {"plots_a", {10, 0, 14}, 0.75, -0.4}, weather, folder);
    shoot(sensors, {"plots_b", {10, 0, 14}, -0.75, -0.4}, weather, folder);
    std::puts("done");
}

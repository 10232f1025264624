#include "exchange/foxglove_scene.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "exchange/base64.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/town.h"

namespace reprise::exchange {

namespace {

using nlohmann::json;

json color(double r, double g, double b, double a = 1) {
    return {{"r", r}, {"g", g}, {"b", b}, {"a", a}};
}

json vector(double x, double y, double z) {
    return {{"x", x}, {"y", y}, {"z", z}};
}

json vector(const Eigen::Vector3d& v) {
    return vector(v.x(), v.y(), v.z());
}

json quaternion(const Eigen::Quaterniond& q) {
    return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

json pose(const Eigen::Vector3d& position, const Eigen::Quaterniond& orientation) {
    return {{"position", vector(position)}, {"orientation", quaternion(orientation)}};
}

Eigen::Quaterniond turned(double yaw) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

/// An entity with every field that the schema has: viewers do not ask whether a list is there.
json entity(const std::string& id, const json& time) {
    json made = {{"timestamp", time},
                 {"frame_id", "world"},
                 {"id", id},
                 {"lifetime", {{"sec", 0}, {"nsec", 0}}},
                 {"frame_locked", false},
                 {"metadata", json::array()}};
    for (const char* list :
         {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"})
        made[list] = json::array();
    return made;
}

json cube(const json& pose_world_cube, const json& size, const json& its_color) {
    return {{"pose", pose_world_cube}, {"size", size}, {"color", its_color}};
}

/// The box around a vehicle's body; its pose is that of the rear axle's middle on the ground.
json body(const Eigen::Isometry3d& pose_world_vehicle, std::uint16_t model, const json& its_color) {
    const auto models = world::vehicle_models();
    const world::VehicleModel& of = models[std::min<std::size_t>(model, models.size() - 1)];
    const Eigen::Vector3d centre =
        pose_world_vehicle * Eigen::Vector3d(of.length / 2 - of.rear_overhang, 0, of.height / 2);
    return cube(pose(centre, Eigen::Quaterniond(pose_world_vehicle.linear())),
                vector(of.length, of.width, of.height),
                its_color);
}

json roads(const world::TownT& town, const json& time) {
    json made = entity("roads", time);
    for (const world::LaneT& lane : town.lanes) {
        const bool driving = world::is_for_cars(lane);
        if (!driving && lane.kind != world::LaneKind::sidewalk)
            continue;
        json points = json::array();
        for (const world::Vec3& point : lane.centre)
            points.push_back(vector(point.x(), point.y(), point.z() - 0.05));
        constexpr int line_strip = 0;
        made["lines"].push_back(
            {{"type", line_strip},
             {"pose", pose({0, 0, 0}, Eigen::Quaterniond::Identity())},
             {"thickness", lane.width},
             {"scale_invariant", false},
             {"points", points},
             {"color", driving ? color(0.3, 0.3, 0.32) : color(0.6, 0.58, 0.55)},
             {"colors", json::array()},
             {"indices", json::array()}});
    }
    return made;
}

json scenery(const world::TownT& town, const json& time) {
    json made = entity("scenery", time);
    for (const world::Building& building : town.buildings)
        made["cubes"].push_back(cube(
            pose(world::to_eigen(building.centre()) + Eigen::Vector3d(0, 0, building.height() / 2),
                 turned(building.yaw())),
            vector(building.length(), building.width(), building.height()),
            color(0.72, 0.68, 0.62)));
    for (const world::Tree& tree : town.trees)
        made["cylinders"].push_back(
            {{"pose",
              pose(world::to_eigen(tree.position()) + Eigen::Vector3d(0, 0, tree.height() / 2),
                   Eigen::Quaterniond::Identity())},
             {"size", vector(2 * tree.crown_radius(), 2 * tree.crown_radius(), tree.height())},
             {"bottom_scale", 0.2},
             {"top_scale", 1.0},
             {"color", color(0.2, 0.45, 0.2)}});
    return made;
}

json signals(const world::TickView& tick, const world::TownT& town, const json& time) {
    json made = entity("signals", time);
    const auto colors = tick.signals();
    for (std::size_t i = 0; i < std::min(colors.size(), town.signals.size()); ++i) {
        if (town.signals[i].for_walkers)
            continue;
        json shown = color(0.3, 0.3, 0.3);
        switch (colors[i]) {
            case world::SignalColor::red:
            case world::SignalColor::stop:
                shown = color(0.9, 0.1, 0.1);
                break;
            case world::SignalColor::red_yellow:
            case world::SignalColor::yellow:
                shown = color(0.95, 0.75, 0.1);
                break;
            case world::SignalColor::green:
            case world::SignalColor::green_minor:
                shown = color(0.1, 0.8, 0.3);
                break;
            case world::SignalColor::off:
                break;
        }
        const Eigen::Vector3d above =
            world::to_eigen(town.signals[i].position) + Eigen::Vector3d(0, 0, 3);
        made["spheres"].push_back({{"pose", pose(above, Eigen::Quaterniond::Identity())},
                                   {"size", vector(0.6, 0.6, 0.6)},
                                   {"color", shown}});
    }
    return made;
}

json vehicle(const world::VehicleState& state,
             const world::TickView& tick,
             const Names& names,
             const json& time) {
    const std::string name = frame_name(state.id(), names);
    json made = entity(name, time);
    const Eigen::Isometry3d pose_world_vehicle = world::pose(state.position(), state.orientation());
    made["cubes"].push_back(body(pose_world_vehicle, state.model(), color(0.85, 0.2, 0.15)));
    const Eigen::Vector3d label = pose_world_vehicle * Eigen::Vector3d(1, 0, 2.5);
    made["texts"].push_back({{"pose", pose(label, Eigen::Quaterniond::Identity())},
                             {"billboard", true},
                             {"font_size", 14.0},
                             {"scale_invariant", true},
                             {"color", color(1, 1, 1)},
                             {"text", name}});
    const auto add = [&](const char* key, const std::string& value) {
        made["metadata"].push_back({{"key", key}, {"value", value}});
    };
    add("id", std::to_string(state.id()));
    if (const auto* measured = world::find(tick.measurements(), state.id()))
        add("speed", fmt::format("{:.2f} m/s", measured->speed()));
    return made;
}

json cars(const world::TickView& tick, const json& time) {
    json made = entity("cars", time);
    for (const world::CarState& car : tick.cars())
        made["cubes"].push_back(body(
            world::pose(
                car.position(), static_cast<double>(car.yaw()), static_cast<double>(car.pitch())),
            car.model(),
            color(0.25, 0.45, 0.8)));
    return made;
}

json walkers(const world::TickView& tick, const json& time) {
    json made = entity("walkers", time);
    const auto models = world::walker_models();
    for (const world::WalkerState& walker : tick.walkers()) {
        const world::WalkerModel& of =
            models[std::min<std::size_t>(walker.model(), models.size() - 1)];
        const double height = walker.down() ? of.shoulder_width : of.height;
        made["cylinders"].push_back(
            {{"pose",
              pose(world::to_eigen(walker.position()) + Eigen::Vector3d(0, 0, height / 2),
                   turned(static_cast<double>(walker.yaw())))},
             {"size", vector(of.shoulder_width, of.shoulder_width, height)},
             {"bottom_scale", 1.0},
             {"top_scale", 0.6},
             {"color", color(0.95, 0.65, 0.2)}});
    }
    return made;
}

}  // namespace

json timestamp(std::uint64_t tick, std::uint64_t step_ns) {
    constexpr std::uint64_t second = 1'000'000'000;
    const std::uint64_t ns = tick * step_ns;
    return {{"sec", ns / second}, {"nsec", ns % second}};
}

std::string frame_name(std::uint32_t id, const Names& names) {
    const auto name = names.find(id);
    return name == names.end() ? fmt::format("vehicle {}", id) : name->second;
}

json town_scene(const world::TownT& town, const json& time) {
    return {{"deletions", json::array()}, {"entities", {roads(town, time), scenery(town, time)}}};
}

json actors_scene(const world::TickView& tick,
                  const world::TownT& town,
                  const Names& names,
                  const json& time) {
    constexpr int all = 1;
    json entities = json::array({signals(tick, town, time), cars(tick, time), walkers(tick, time)});
    for (const world::VehicleState& state : tick.vehicles())
        entities.push_back(vehicle(state, tick, names, time));
    return {{"deletions", {{{"timestamp", time}, {"type", all}, {"id", ""}}}},
            {"entities", entities}};
}

json transforms(const world::TickView& tick, const Names& names, const json& time) {
    json list = json::array();
    for (const world::VehicleState& state : tick.vehicles())
        list.push_back({{"timestamp", time},
                        {"parent_frame_id", "world"},
                        {"child_frame_id", frame_name(state.id(), names)},
                        {"translation", vector(world::to_eigen(state.position()))},
                        {"rotation", quaternion(world::to_eigen(state.orientation()))}});
    return {{"transforms", list}};
}

json point_cloud(const PointCloud& cloud,
                 const Eigen::Isometry3d& pose_world_sensor,
                 const json& time) {
    enum NumericType { uint32 = 5, float32 = 7 };

    json fields = json::array();
    for (const PointCloud::Column& column : cloud.columns)
        fields.push_back({{"name", column.name},
                          {"offset", 4 * fields.size()},
                          {"type", static_cast<int>(column.whole ? uint32 : float32)}});
    return {{"timestamp", time},
            {"frame_id", "world"},
            {"pose",
             pose(pose_world_sensor.translation(), Eigen::Quaterniond(pose_world_sensor.linear()))},
            {"point_stride", cloud.row_bytes()},
            {"fields", fields},
            {"data", base64(cloud.rows)}};
}

}  // namespace reprise::exchange

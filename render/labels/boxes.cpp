// What it must do: say of every actor that is seen where it is, in the picture and in space.
// What it assumes: both frames are of this tick and camera.
// How it goes: pixels are counted by their instance; each actor looks up its own count.
// What it keeps: nothing.
#include "render/labels/boxes.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>

#include "render/shapes/cars/two_wheeler.h"
#include "render/shapes/people/figure.h"
#include "render/shapes/people/figure_bounds.h"
#include "world/check.h"
#include "world/external/instance_id.h"
#include "world/frames.h"
#include "world/models/actors.h"

namespace reprise::render {

namespace {

struct Count {
    std::size_t pixels = 0;
    PixelBox around{1e9, 1e9, 0, 0};
    std::map<std::uint8_t, std::size_t> classes;

    /// A rider and his bicycle are one actor: what most of the pixels say.
    world::SemanticClass most() const {
        const auto found = std::max_element(
            classes.begin(), classes.end(), [](const auto& left, const auto& right) {
                return left.second < right.second;
            });
        return static_cast<world::SemanticClass>(found->first);
    }
};

/// Of those that have a box.
std::map<std::uint16_t, Count> count_pixels(const world::SensorFrame& instances,
                                            const world::SensorFrame& classes,
                                            std::span<const ParkedVehicle> parked) {
    std::vector<bool> counts_at_all(0x10000, false);
    std::fill(
        counts_at_all.begin() + 1, counts_at_all.begin() + world::first_static_instance, true);
    for (const ParkedVehicle& vehicle : parked)
        counts_at_all[world::instance_of_thing(vehicle.thing)] = true;
    std::map<std::uint16_t, Count> counts;
    for (int y = 0; y < instances.height; ++y)
        for (int x = 0; x < instances.width; ++x) {
            const auto index = static_cast<std::size_t>(y * instances.width + x);
            std::uint16_t instance = 0;
            std::memcpy(&instance, instances.data.data() + 2 * index, sizeof(instance));
            if (!counts_at_all[instance])
                continue;
            Count& count = counts[instance];
            ++count.pixels;
            ++count.classes[classes.data[index]];
            count.around.left = std::min(count.around.left, static_cast<double>(x));
            count.around.top = std::min(count.around.top, static_cast<double>(y));
            count.around.right = std::max(count.around.right, x + 1.0);
            count.around.bottom = std::max(count.around.bottom, y + 1.0);
        }
    return counts;
}

/// Of somebody on foot: around limbs and luggage, which reach out of the body that others bump
/// into.
ActorBox figure_box(const world::TickView& tick, const world::WalkerState& walker) {
    const auto models = world::walker_models();
    REPRISE_CHECK(walker.model() < models.size(), "walker " + std::to_string(walker.id()));
    const Eigen::AlignedBox3d bounds =
        figure_bounds(models[walker.model()], walker, umbrellas_are_open(tick));
    return {world::pose(walker.position(), static_cast<double>(walker.yaw()), 0) *
                Eigen::Translation3d(bounds.center()),
            bounds.sizes()};
}

/// As it is seen: leaning, with who rides it. Nothing of all that is no two-wheeler.
std::optional<ActorBox> ridden_box(const world::TickView& tick, std::uint32_t actor) {
    const auto models = world::vehicle_models();
    const auto around = [&](const Eigen::Isometry3d& pose, std::uint16_t model) {
        const Eigen::AlignedBox3d& bounds = ridden_bounds(model);
        return ActorBox{pose * Eigen::Translation3d(bounds.center()), bounds.sizes()};
    };
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), actor);
        vehicle != nullptr && world::is_two_wheeler(models[vehicle->model()].body))
        return around(leaning_pose(*vehicle), vehicle->model());
    if (const world::CarState* car = world::find(tick.cars(), actor);
        car != nullptr && world::is_two_wheeler(models[car->model()].body))
        return around(world::find_pose(tick, actor).value(), car->model());
    return std::nullopt;
}

}  // namespace

std::optional<ActorBox> actor_box(const world::TickView& tick, std::uint32_t actor) {
    if (const world::WalkerState* walker = world::find(tick.walkers(), actor))
        return figure_box(tick, *walker);
    const auto extent = world::find_extent(tick, actor);
    if (const auto ridden = ridden_box(tick, actor))
        return ridden;
    const auto pose = world::find_pose(tick, actor);
    if (!extent || !pose)
        return std::nullopt;
    return ActorBox{*pose * Eigen::Translation3d(extent->middle(), 0, extent->height / 2),
                    {extent->front - extent->rear, 2 * extent->half_width, extent->height}};
}

std::vector<ParkedVehicle> parked_vehicles(const world::TownT& town) {
    const auto models = world::vehicle_models();
    const std::size_t first = world::TownThings(town).props;
    std::vector<ParkedVehicle> parked;
    for (std::size_t i = 0; i < town.props.size(); ++i) {
        const world::Prop& prop = town.props[i];
        if (prop.kind() != world::PropKind::parked_vehicle)
            continue;
        REPRISE_CHECK(prop.value() < models.size(), "thing " + std::to_string(first + i));
        const world::VehicleModel& model = models[prop.value()];
        parked.push_back({static_cast<std::uint32_t>(first + i),
                          static_cast<std::uint16_t>(prop.value()),
                          {world::pose(prop.position(), prop.yaw(), 0) *
                               Eigen::Translation3d(0, 0, model.height / 2),
                           {model.length, model.width, model.height}}});
    }
    return parked;
}

std::vector<LabelBox> boxes_of(const world::TickView& tick,
                               std::span<const ParkedVehicle> parked,
                               const Camera& camera,
                               const world::SensorFrame& instances,
                               const world::SensorFrame& classes) {
    const std::map<std::uint16_t, Count> counts = count_pixels(instances, classes, parked);
    std::vector<std::uint32_t> actors;
    const auto note = [&](const auto& those) {
        for (const auto& one : those)
            actors.push_back(one.id());
    };
    note(tick.vehicles());
    note(tick.cars());
    note(tick.walkers());
    note(tick.props());
    std::sort(actors.begin(), actors.end());
    Eigen::Isometry3d pose_world_camera = Eigen::Isometry3d::Identity();
    pose_world_camera.linear() = camera.rotation_scene_camera();
    pose_world_camera.translation() = camera.position();
    std::vector<LabelBox> boxes;
    /// The new one, of an instance that is seen.
    const auto add = [&](std::uint16_t instance, const ActorBox& around) -> LabelBox& {
        const Count& count = counts.at(instance);
        LabelBox& box = boxes.emplace_back();
        box.instance = instance;
        box.what = count.most();
        box.pixels = count.pixels;
        box.seen = count.around;
        box.size = around.size;
        box.whole = box_in_picture(camera, around.pose_world, box.size).value_or(box.seen);
        box.pose_camera = pose_world_camera.inverse() * around.pose_world;
        return box;
    };
    for (const std::uint32_t actor : actors)
        if (const std::uint16_t instance = world::instance_of_actor(actor);
            counts.contains(instance))
            if (const auto around = actor_box(tick, actor))
                add(instance, *around).actor = actor;
    for (const ParkedVehicle& vehicle : parked)
        if (const std::uint16_t instance = world::instance_of_thing(vehicle.thing);
            counts.contains(instance))
            add(instance, vehicle.box).thing = vehicle.thing;
    return boxes;
}

}  // namespace reprise::render

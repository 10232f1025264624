#include "render/overlay/tags.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "world/frames.h"
#include "world/models/actors.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

constexpr double kmh = 3.6;
constexpr double over_actor = 0.25;    // [m]
constexpr double nearest_point = 0.3;  // [m] before the camera
constexpr double demand_reach = 70;    // [m] farther away cars of the demand have no tag
constexpr double seen_share = 0.12;    // of an actor's sides that makes it seen
constexpr double smallest = 0.03;      // of the picture's width; smaller ones of the demand: none

/// One point of an actor's box, as the camera sees it.
struct Look {
    bool in_picture = false;
    bool free = false;  ///< nothing before it
};

Look look_at(const Vector3d& p_world, const Camera& camera, const world::SensorFrame& depth) {
    const Vector3d seen = camera.project(p_world);
    if (seen.z() < nearest_point || seen.x() < 0 || seen.y() < 0 || seen.x() >= camera.width() ||
        seen.y() >= camera.height())
        return {};
    const auto column = static_cast<std::size_t>(seen.x());
    const auto row = static_cast<std::size_t>(seen.y());
    float found = 0;
    const std::size_t index = row * static_cast<std::size_t>(camera.width()) + column;
    std::memcpy(&found, depth.data.data() + index * sizeof(float), sizeof(float));
    // The actor itself is inside of its box, and never before it.
    const double slack = 0.1 + 0.01 * seen.z();
    return {true, static_cast<double>(found) > seen.z() - slack};
}

/// Of nine points on each side of the box that is turned to the camera: how many are in the
/// picture, and how many of these are free.
struct Sides {
    int in_picture = 0;
    int free = 0;

    bool seen() const { return free > seen_share * in_picture; }
};

Sides look_at_sides(const Eigen::Isometry3d& pose,
                    const world::Extent& extent,
                    const Camera& camera,
                    const world::SensorFrame& depth) {
    const Vector3d middle(extent.middle(), 0, extent.height / 2);
    const Vector3d half((extent.front - extent.rear) / 2, extent.half_width, extent.height / 2);
    Sides sides;
    for (int axis = 0; axis < 3; ++axis)
        for (const int sign : {-1, 1}) {
            const Vector3d out = sign * Vector3d::Unit(axis);
            const Vector3d centre = pose * (middle + out.cwiseProduct(half));
            if ((camera.position() - centre).dot(pose.linear() * out) <= 0)
                continue;
            const Vector3d across = Vector3d::Unit((axis + 1) % 3).cwiseProduct(half) * 0.8;
            const Vector3d along = Vector3d::Unit((axis + 2) % 3).cwiseProduct(half) * 0.8;
            for (int u = -1; u <= 1; ++u)
                for (int v = -1; v <= 1; ++v) {
                    const Look look =
                        look_at(centre + pose.linear() * (u * across + v * along), camera, depth);
                    sides.in_picture += look.in_picture ? 1 : 0;
                    sides.free += look.free ? 1 : 0;
                }
        }
    return sides;
}

/// Where a tag stands: in the middle over the actor, wherever it is looked at from.
std::optional<Vector3d> place_of(const Eigen::Isometry3d& pose,
                                 const world::Extent& extent,
                                 const Camera& camera) {
    const Vector3d lift(0, 0, over_actor);
    Vector3d place = camera.project(pose * Vector3d(extent.middle(), 0, extent.height) + lift);
    if (place.z() < nearest_point)
        return std::nullopt;
    for (const double x : {extent.rear, extent.front})
        for (const double y : {-extent.half_width, extent.half_width}) {
            const Vector3d corner = camera.project(pose * Vector3d(x, y, extent.height) + lift);
            if (corner.z() >= nearest_point)
                place.y() = std::min(place.y(), corner.y());
        }
    return place;
}

std::string text_of(const std::string& name, double speed) {
    const long whole = std::lround(std::abs(speed) * kmh);
    return name.empty() ? fmt::format("{} km/h", whole) : fmt::format("{} {} km/h", name, whole);
}

}  // namespace

std::vector<Tag> tags_of(const world::TickView& tick,
                         const ActorNames& names,
                         const Camera& camera,
                         const world::SensorFrame& depth,
                         std::uint32_t carrier) {
    std::vector<Tag> tags;
    const auto add = [&](std::uint32_t actor, double speed) {
        const auto pose = world::find_pose(tick, actor);
        const auto extent = world::find_extent(tick, actor);
        if (actor == carrier || !pose || !extent)
            return;
        const auto name = names.find(actor);
        const bool named = name != names.end();
        const auto place = place_of(*pose, *extent, camera);
        if (!place)
            return;
        const double size = (extent->front - extent->rear) / (place->z() * camera.pixel());
        if (!named && (place->z() > demand_reach || size < smallest * camera.width()))
            return;
        const Sides sides = look_at_sides(*pose, *extent, camera, depth);
        if (sides.in_picture == 0 || (!named && !sides.seen()))
            return;
        tags.push_back({actor,
                        text_of(named ? name->second : "", speed),
                        place->x(),
                        place->y(),
                        place->z(),
                        named,
                        !sides.seen()});
    };
    for (const world::VehicleState& vehicle : tick.vehicles()) {
        const world::Measurement* own = world::find(tick.measurements(), vehicle.id());
        add(vehicle.id(),
            own != nullptr ? own->speed() : world::to_eigen(vehicle.velocity()).norm());
    }
    for (const world::CarState& car : tick.cars())
        add(car.id(), static_cast<double>(car.speed()));
    for (const world::WalkerState& walker : tick.walkers())
        add(walker.id(), static_cast<double>(walker.speed()));
    std::stable_sort(tags.begin(), tags.end(), [](const Tag& one, const Tag& other) {
        return one.depth > other.depth;
    });
    return tags;
}

}  // namespace reprise::render

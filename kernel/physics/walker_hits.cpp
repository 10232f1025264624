#include "kernel/physics/walker_hits.h"

#include <algorithm>
#include <cmath>

#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

/// [m] from a vehicle's centre of mass to the farthest walker that it can reach within a tick: half
/// a bus and 80 m/s of closing speed.
constexpr double reach = 12;

}  // namespace

void WalkerHits::choose(std::span<const world::WalkerState> last,
                        std::span<const world::WalkerState> next,
                        std::span<const btVector3> centres,
                        double step,
                        const Displaced& displaced) {
    near_.clear();
    for (const world::WalkerState& walker : next) {
        const btVector3 to = to_bullet(walker.position());
        const bool close =
            std::any_of(centres.begin(), centres.end(), [&](const btVector3& centre) {
                return centre.distance2(to) < reach * reach;
            });
        if (!close || walker.down())
            continue;
        const world::WalkerState* before =
            holds(displaced, walker.id()) ? nullptr : world::find(last, walker.id());
        const btVector3 from = before != nullptr ? to_bullet(before->position()) : to;
        const world::WalkerModel& model = world::walker_models()[walker.model()];
        near_.push_back({walker.id(),
                         model.shoulder_width / 2,
                         model.height,
                         model.mass,
                         from,
                         to - from,
                         (to - from) / step});
    }
    std::erase_if(touching_, [&](const auto& both) {
        return std::none_of(near_.begin(), near_.end(), [&](const Near& walker) {
            return walker.id == both.second;
        });
    });
}

void WalkerHits::test(double share,
                      std::span<const std::unique_ptr<Vehicle>> vehicles,
                      Collisions& collisions) {
    for (const Near& walker : near_)
        for (const auto& vehicle : vehicles)
            hit(walker, walker.from + walker.way * share, *vehicle, collisions);
}

void WalkerHits::hit(const Near& walker,
                     const btVector3& p_walker,
                     Vehicle& vehicle,
                     Collisions& collisions) {
    // The walker's middle in the vehicle's frame, and the nearest point of the box in the plane.
    btRigidBody& body = vehicle.body();
    const btTransform& pose = body.getCenterOfMassTransform();
    const btVector3 centre = to_bullet(vehicle.model().box_centre);
    const btVector3 half = to_bullet(vehicle.model().box_half);
    const btVector3 p = pose.inverse()(p_walker + btVector3(0, 0, walker.height / 2)) - centre;
    const btVector3 nearest(std::clamp(p.x(), -half.x(), half.x()),
                            std::clamp(p.y(), -half.y(), half.y()),
                            std::clamp(p.z(), -half.z(), half.z()));
    const double out_x = p.x() - nearest.x();
    const double out_y = p.y() - nearest.y();
    const double distance = std::sqrt(out_x * out_x + out_y * out_y);
    const bool touches =
        distance <= walker.radius && std::abs(p.z()) <= half.z() + walker.height / 2;

    const auto key = std::make_pair(vehicle.id(), walker.id);
    const auto at = std::lower_bound(touching_.begin(), touching_.end(), key);
    const bool touched = at != touching_.end() && *at == key;
    if (!touches) {
        if (touched)
            touching_.erase(at);
        return;
    }
    if (touched)
        return;
    // Outwards from the box; from its middle when the walker appeared inside.
    btVector3 outwards = distance > 0 ? btVector3(out_x / distance, out_y / distance, 0)
                                      : btVector3(p.x() < 0 ? -1 : 1, 0, 0);
    outwards = pose.getBasis() * outwards;
    const btVector3 arm = pose.getBasis() * (centre + nearest);
    const double vehicle_speed = body.getVelocityInLocalPoint(arm).dot(outwards);
    const double closing = vehicle_speed - walker.velocity.dot(outwards);
    if (vehicle_speed < least_vehicle_speed || closing <= 0)
        return;
    touching_.insert(at, key);
    const double impulse = walker.mass * closing;
    body.applyImpulse(-outwards * impulse, arm);
    collisions.add(vehicle.id(), walker.id, impulse, pose.getOrigin() + arm);
}

void WalkerHits::add_to(world::Hasher& hasher) const {
    hasher.add(static_cast<std::uint64_t>(touching_.size()));
    for (const auto& [vehicle, walker] : touching_) {
        hasher.add(vehicle);
        hasher.add(walker);
    }
}

}  // namespace reprise::kernel

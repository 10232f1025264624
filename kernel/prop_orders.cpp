#include "kernel/prop_orders.h"

#include "world/frames.h"

namespace reprise::kernel {

namespace {

Eigen::Isometry3d pose_of(const world::TownT& town,
                          const world::CommandT& spawn,
                          const Physics& physics) {
    if (spawn.has_pose)
        return physics.prop_stance(spawn.model, world::to_eigen(spawn.target), spawn.heading);
    const world::LanePoint place = world::point_at(town.lanes.at(spawn.lane), spawn.s);
    return world::pose(world::to_vec3(place.position), place.yaw, place.pitch) *
           Eigen::Translation3d(0, spawn.offset, 0);
}

}  // namespace

void place_props(const world::TownT& town, world::TickDraft& next, Physics& physics) {
    for (const world::CommandT& command : next.tick.commands) {
        const bool comes =
            command.kind == world::CommandKind::spawn && command.driver == world::Driver::prop;
        const bool goes =
            command.kind == world::CommandKind::despawn && physics.has_prop(command.actor);
        if (!comes && !goes)
            continue;
        world::EventT event;
        event.kind = comes ? world::EventKind::spawned : world::EventKind::despawned;
        event.actor = command.actor;
        event.text = command.text;
        event.line = command.line;
        if (comes) {
            const Eigen::Isometry3d pose = pose_of(town, command, physics);
            physics.add_prop(command.actor, command.model, pose);
            event.position = world::to_vec3(pose.translation());
        } else {
            event.position = physics.remove_prop(command.actor);
        }
        next.tick.events.push_back(std::move(event));
    }
}

}  // namespace reprise::kernel

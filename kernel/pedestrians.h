#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ground/mesh/ground.h"
#include "walkers/crowd.h"
#include "walkers/on_foot.h"
#include "walkers/walking_ground.h"
#include "world/episode_generated.h"
#include "world/models/gait.h"
#include "world/tick.h"
#include "world/town.h"
#include "world/trajectory.h"

namespace reprise::kernel {

using world::walk_cycle_length;

/// The walkers that a scenario spawns: each goes in a straight line, or by the walk map, to where
/// it was told, at the speed it was told (reached with 2 m/s^2), and stops there; or is where a
/// trajectory says. One that a vehicle with mass has hit lies where it was and does nothing more.
/// And those in the background that the episode asks for (walkers::Crowd).
class Pedestrians {
  public:
    /// `town`, its `lanes` and its `ground` must outlive this.
    Pedestrians(const world::EpisodeT& episode,
                const world::TownT& town,
                const world::LaneMap& lanes,
                const ground::GroundMesh& ground);

    /// Stage 4. Carries out the next tick's commands for walkers (spawn, walk, set_speed,
    /// free_speed, follow, teleport, set_velocity, despawn), moves everyone by one tick, and says
    /// where they are (sorted by id), who came and who went. Reads nothing of what traffic does in
    /// that tick, so both may run at once.
    ///
    /// spawn: at lane, s, offset; without a lane at `target`. walk: to `target` with `speed`; 0 is
    /// the model's own walking speed. Commands for actors that are no walkers are left to other
    /// stages.
    walkers::OnFoot advance(const world::TickView& last, std::span<const world::CommandT> commands);

    /// Are there enough of them that a thread of its own pays?
    bool are_many() const { return are_many_; }

    /// A drill's: moves the unrounded number behind a recorded one by so many units in the last
    /// place.
    void nudge(std::uint32_t id, std::string_view field, std::int64_t units);

    /// Of the unrounded state of everyone.
    std::uint64_t digest() const;

  private:
    struct Walker {
        std::uint32_t id = 0;
        std::uint16_t model = 0;
        Eigen::Vector3d position{0, 0, 0};  ///< world, between the feet
        Eigen::Vector3d target{0, 0, 0};
        double yaw = 0;
        double speed = 0;
        double wanted_speed = 0;
        double phase = 0;  ///< of the walk cycle, in [0, 1)
        bool walking = false;
        bool down = false;
        std::vector<Eigen::Vector3d> way{};             ///< by the walk map: corners behind target
        std::optional<world::Trajectory> trajectory{};  ///< says where it is
        std::uint64_t trajectory_start = 0;             ///< tick of its time 0
    };

    Walker* find(std::uint32_t id);
    void obey(const world::CommandT& command, walkers::OnFoot& next);
    void spawn(const world::CommandT& command, walkers::OnFoot& next);
    void despawn(const world::CommandT& command, walkers::OnFoot& next);
    void lay_down(const world::TickView& last);
    void place(const world::CommandT& command, Walker& walker) const;
    void teleport(const world::CommandT& command, Walker& walker) const;
    void follow(Walker& walker, std::uint64_t tick) const;
    void step_on(Walker& walker, double distance, double speed) const;
    void walk(Walker& walker) const;
    void take_way(const world::CommandT& command, Walker& walker, walkers::OnFoot& next);
    walkers::WalkingGround& walking_ground();
    double ground_height(const Eigen::Vector3d& p_world) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    const ground::GroundMesh* ground_;
    std::uint64_t seed_;                                      ///< of the looks
    double step_;                                             ///< [s]
    bool are_many_;                                           ///< to walk about in the background
    std::vector<Walker> walkers_;                             ///< sorted by id
    std::unique_ptr<walkers::WalkingGround> walking_ground_;  ///< once somebody needs it
    std::unique_ptr<walkers::Crowd> crowd_;                   ///< where the episode asks for one
};

}  // namespace reprise::kernel

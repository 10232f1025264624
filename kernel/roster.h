#pragma once

#include <cstdint>
#include <exception>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "drivers/driver.h"
#include "kernel/physics/impact.h"
#include "kernel/physics/physics.h"
#include "world/episode_generated.h"
#include "world/obstacle.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::kernel {

/// The vehicles with mass and who drives them: what the scenario asked for, kept in id order.
class Roster {
  public:
    /// `episode`, `town` and `lanes` must outlive the roster; `obstacles` are looked at here only.
    Roster(const world::EpisodeT& episode,
           const world::TownT& town,
           const world::LaneMap& lanes,
           std::span<const world::Obstacle> obstacles);

    /// Carries out next's commands for vehicles with mass: puts them into physics, takes them out,
    /// and hands speed, route and control on to their drivers. Writes spawned and despawned events.
    /// Fills in the place of a vehicle that the scenario left to chance.
    void apply_commands(const world::TickView& last, world::TickDraft& next, Physics& physics);

    /// Behind the commands of `tick`: what each autopilot decides from the last one, for
    /// apply_controls. Touches nothing but them, so other stages may run meanwhile. What one of
    /// them throws is thrown by apply_controls.
    void decide(const world::TickView& last, std::uint64_t tick);

    /// Stage 2: writes next.tick.controls, one for each vehicle: the autopilot's decision, or for
    /// manual ones the newest of `controls`.
    void apply_controls(std::span<const world::Control> controls,
                        const world::TickView& last,
                        world::TickDraft& next);

    /// Behind the physics: those that have become vehicles in this tick, with their controls. From
    /// now on they are the roster's. Nobody drives them: what the scenario says to one but despawn,
    /// lamps and doors is answered by a printed line, once for each word.
    void take_over(std::span<const Wreck> wrecks, world::TickDraft& next);

    /// Likewise: those whom a crash took from their trajectory. Their drivers go on.
    void end_trajectories(std::span<const std::uint32_t> derailed);

    /// Does the driver of this vehicle want to get on? The autopilot until its road ends or it
    /// is told to stand. A scenario that drives by itself: while it gives throttle. Whoever else
    /// drives: once the vehicle has moved or is given throttle. Never with the hand brake on.
    bool is_under_way(const world::VehicleState& vehicle) const;

    /// A drill's: takes the place of the newest control of this actor.
    void replace_control(const world::Control& control);

    std::uint64_t digest() const;

  private:
    struct Entry {
        std::uint16_t model = 0;                      ///< in the vehicle catalogue
        std::optional<drivers::Autopilot> autopilot;  ///< none: manual
        world::Control control;                       ///< the newest
        bool scripted = false;                        ///< the scenario gave one: it drives
        /// Tick until which it holds the speed of its spawn, unless somebody drives before; 0: no.
        std::uint64_t rolls_until = 0;
        std::uint32_t route_line = 0;  ///< of the scenario, that last asked for a route
        /// Last tick in which a trajectory says where it is; 0: none.
        std::uint64_t follows_until = 0;
        std::uint64_t moved_at = 0;  ///< tick in which it was put elsewhere or given another speed
        std::exception_ptr mistake{};  ///< why its autopilot cannot decide
        std::uint64_t wrecked_at = 0;  ///< tick; 0: it is none
        std::uint32_t told = 0;        ///< a wreck: bit for each CommandKind that was answered
    };

    void refuse(const world::CommandT& command, Entry& entry, world::TickDraft& next) const;
    void carry_out(const world::CommandT& command,
                   Entry& entry,
                   std::uint64_t tick,
                   Physics& physics) const;
    void follow(const world::CommandT& command,
                Entry& entry,
                std::uint64_t tick,
                Physics& physics) const;
    void move(const world::CommandT& command,
              Entry& entry,
              std::uint64_t tick,
              Physics& physics) const;
    Eigen::Isometry3d pose_of(const world::CommandT& command,
                              std::uint16_t model,
                              const Physics& physics) const;
    void roll(Entry& entry, const world::CommandT& spawn, double climb, std::uint64_t tick) const;
    static bool decides(const Entry& entry,
                        std::uint32_t id,
                        const world::TickView& last,
                        std::uint64_t tick);
    void tell_news(const Entry& entry, const world::TickView& last, world::TickDraft& next) const;
    void despawn(const world::CommandT& command, world::TickDraft& next, Physics& physics);
    void spawn(const world::TickView& last,
               world::CommandT& command,
               world::TickDraft& next,
               Physics& physics);
    void choose_place(const world::TickView& last,
                      std::span<const world::CommandT> said,
                      world::CommandT& command) const;
    bool is_free(const world::TickView& last,
                 std::span<const world::CommandT> said,
                 const world::CommandT& self,
                 const Eigen::Vector3d& p_world) const;

    const world::EpisodeT* episode_;
    const world::TownT* town_;
    drivers::RoadMap map_;
    std::map<std::uint32_t, Entry> entries_;
    std::map<std::uint32_t, std::string> names_;  ///< of the scenario's cars without mass
};

}  // namespace reprise::kernel

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "tests/support/towns.h"
#include "traffic/background.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::test {

/// Runs nothing but traffic: tick by tick, with commands and with physics vehicles put where the
/// test wants them.
class Stage {
  public:
    Stage(const Loaded& loaded, std::uint32_t cars, std::uint64_t seed = 7);

    /// One tick; `commands` are carried out in it. The vehicles are part of its result, so that
    /// traffic sees them in the tick after.
    const world::TickDraft& step(const std::vector<world::CommandT>& commands = {},
                                 const std::vector<world::VehicleState>& vehicles = {});

    void steps(int count);

    /// Others that are there from now on, as the other stages would write them: traffic sees them
    /// from the tick after the next on.
    std::vector<world::WalkerState> walkers;
    std::vector<world::PropState> props;
    std::vector<world::Door> doors;

    /// Who has his blue lamps on from now on, as the kernel lights them behind traffic.
    std::vector<std::uint32_t> beacons;

    /// The car in the last tick, or null.
    const world::CarState* car(std::uint32_t id) const;

    std::uint64_t digest() const { return background_->digest(); }

    const world::TickDraft& draft() const { return draft_; }

    world::TickView view() const { return last_.view(); }

    std::uint64_t tick() const { return draft_.tick.index; }

  private:
    world::EpisodeT episode_;
    world::LaneMap lanes_;
    std::unique_ptr<traffic::Background> background_;
    world::TickDraft draft_;
    world::SealedTick last_;
};

world::CommandT spawn(std::uint32_t actor,
                      std::uint32_t lane,
                      double s,
                      double speed = 0,
                      world::Driver driver = world::Driver::traffic,
                      double offset = 0);
world::CommandT command(world::CommandKind kind, std::uint32_t actor);

/// A sedan of mass on the lane's centre line, its origin at s, heading along it.
world::VehicleState vehicle_on(const world::LaneT& lane,
                               std::uint32_t id,
                               double s,
                               double speed = 0);

}  // namespace reprise::test

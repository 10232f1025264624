#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "replay/score/infraction.h"
#include "world/lanes/stop_lines.h"
#include "world/models/catalogue.h"
#include "world/spawns.h"
#include "world/town.h"

namespace reprise::replay {

/// The place of a drive: what never changes, and what is worked out of it once.
struct DrivenTown {
    explicit DrivenTown(const world::TownT& driven);

    const world::TownT& town;
    world::StopLines signal_lines;  ///< where lights are
    world::StopLines sign_lines;    ///< where stop signs stand
};

/// A vehicle with mass in a tick.
struct Sight {
    const world::TickView& tick;
    const world::VehicleState& vehicle;
    const world::Measurement& measured;
    const world::VehicleModel& model;
    double step = 0.05;   ///< [s]
    double driven = 0;    ///< [m] since the tick before, either way
    bool is_put = false;  ///< it was put here: it did not drive from where it was

    std::uint64_t index() const { return tick.index(); }

    Eigen::Vector3d position() const;
    double yaw() const;

    /// [m] that a vehicle may have driven in a tick; what moved farther was put there.
    static double farthest(double speed, double step) { return 2 * std::abs(speed) * step + 2; }

    /// From the reference point to the front bumper. [m]
    double front() const { return model.length - model.rear_overhang; }
};

/// Where a vehicle was in the tick before.
struct LastSeen {
    bool is_known = false;
    double odometer = 0;
    Eigen::Vector3d position{0, 0, 0};
};

/// `last` is then that of this tick. The model must be one of the catalogue.
Sight see(const world::TickView& tick,
          const world::VehicleState& vehicle,
          const world::Measurement& measured,
          double step,
          LastSeen& last);

/// Somebody drives it, and may do wrong. Nobody drives a wreck: it was a car without mass, until
/// something hit it. `spawns`: up to this tick.
bool is_driven(const world::Spawns& spawns, std::uint32_t vehicle);

/// Watches one vehicle for one infraction. Ticks are shown in their order, from the one of its
/// spawn on. What it says depends on these ticks and the town alone.
class Watch {
  public:
    virtual ~Watch() = default;
    Watch() = default;
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    virtual void look(const Sight& sight) = 0;

    /// Nothing comes any more.
    virtual void finish() {}

    /// Those that have ended, and are told once.
    std::vector<Infraction> take();

    /// Those of which it is sure, as far as they have come: each is told once, and ends later.
    std::vector<Infraction> take_begun();

  protected:
    void begin(const Infraction& infraction) { begun_.push_back(infraction); }

    void end(const Infraction& infraction) { ended_.push_back(infraction); }

    /// One that begins in this tick, and may end in it.
    static Infraction begun(InfractionKind kind, const Sight& sight, double worst);

  private:
    std::vector<Infraction> begun_;
    std::vector<Infraction> ended_;
};

/// Of what is so for some time: ticks less than half a second apart are one episode, as touches
/// are one contact.
class LastingWatch : public Watch {
  public:
    /// `shortest`: [s] what is shorter is none.
    LastingWatch(InfractionKind kind, double shortest) : kind_(kind), shortest_(shortest) {}

    void look(const Sight& sight) final;
    void finish() final;

  protected:
    /// How bad it is in this tick, if it is; see Infraction::worst.
    virtual std::optional<double> value(const Sight& sight) = 0;

    /// Of an episode: the largest value, or their sum where they are metres driven.
    virtual bool adds_up() const { return false; }

  private:
    bool is_long_enough() const;

    InfractionKind kind_;
    double shortest_;
    double step_ = 0;
    std::optional<Infraction> open_;
    bool is_sure_ = false;  ///< it has been long enough
};

/// Is most of it where no lane leads its way: over an opposite lane, a sidewalk, or off the road?
bool is_off_lane(const Sight& sight);

/// A watch for each infraction, in the order of their kinds.
std::vector<std::unique_ptr<Watch>> all_watches(const DrivenTown& town);

}  // namespace reprise::replay

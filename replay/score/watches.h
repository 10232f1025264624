// Private to the folder: the watches that all_watches makes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "replay/score/watch.h"

namespace reprise::replay {

/// Which line the front bumper crosses from one tick to the next.
class FrontWatch {
  public:
    std::optional<std::uint32_t> crossed(const world::StopLines& lines, const Sight& sight) const;
    void remember(const Sight& sight);

  private:
    std::optional<Eigen::Vector3d> p_front_;
};

/// As `ego:ran_red()` of a scenario, told once for each line.
class RedLightWatch final : public Watch {
  public:
    explicit RedLightWatch(const DrivenTown& town) : town_(town) {}

    void look(const Sight& sight) override;

  private:
    const DrivenTown& town_;
    FrontWatch front_;
    world::RedLightWatch lights_;
    std::optional<Infraction> at_line_;  ///< the line that was crossed last
};

/// Who crosses the line of a stop sign without having stood at it.
class StopSignWatch final : public Watch {
  public:
    explicit StopSignWatch(const DrivenTown& town) : town_(town) {}

    void look(const Sight& sight) override;

  private:
    const DrivenTown& town_;
    FrontWatch front_;
    std::optional<double> since_stop_;  ///< [m] driven since it stood
};

class SpeedWatch final : public LastingWatch {
  public:
    explicit SpeedWatch(const DrivenTown& town)
        : LastingWatch(InfractionKind::speeding, 0),
          town_(town) {}

  private:
    std::optional<double> value(const Sight& sight) override;

    const DrivenTown& town_;
    std::optional<double> limit_;  ///< [m/s] of the last lane of a street
};

/// More than 30 % of the footprint over a lane that runs the other way, or over a sidewalk.
class ShareWatch final : public LastingWatch {
  public:
    explicit ShareWatch(InfractionKind kind) : LastingWatch(kind, 0), kind_(kind) {}

  private:
    std::optional<double> value(const Sight& sight) override;

    InfractionKind kind_;
};

/// Mostly over lanes that run the other way, longer than one passes what stands in the way.
class WrongWayWatch final : public LastingWatch {
  public:
    WrongWayWatch() : LastingWatch(InfractionKind::wrong_way, 5) {}

  private:
    std::optional<double> value(const Sight& sight) override;

    bool adds_up() const override { return true; }
};

/// On neither road nor sidewalk: with two wheels or more.
class OffRoadWatch final : public LastingWatch {
  public:
    OffRoadWatch() : LastingWatch(InfractionKind::off_road, 0) {}

  private:
    std::optional<double> value(const Sight& sight) override;

    bool adds_up() const override { return true; }
};

/// As the events tell it: one contact is one, however long it lasts.
class CollisionWatch final : public Watch {
  public:
    void look(const Sight& sight) override;
    void finish() override;

  private:
    InfractionKind kind_of(const Sight& sight, std::uint32_t other) const;

    std::map<std::uint32_t, Infraction> open_;  ///< by the other one's id
    double impulse_walkers_ = 0;                ///< [N s] at the last tick
    std::uint64_t last_ = 0;                    ///< tick
};

/// On its way, and slower than 0.1 m/s for a minute.
class BlockedWatch final : public Watch {
  public:
    void look(const Sight& sight) override;
    void finish() override;

  private:
    std::optional<Infraction> open_;
};

}  // namespace reprise::replay

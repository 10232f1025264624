#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "world/geometry2d.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::world {

/// The lines at which vehicles stop: across the ends of lanes for cars.
class StopLines {
  public:
    /// Of the lanes from where a link with a signal leads on.
    explicit StopLines(const TownT& town);

    /// Of these lanes; ascending.
    StopLines(const TownT& town, std::span<const std::uint32_t> lanes);

    bool empty() const { return lines_.empty(); }

    /// The lane whose line the point of a vehicle crosses on its way, in driving direction. A line
    /// counts as crossed `slack` behind it: who stands a hand's breadth too far stands at it.
    /// O(lines near).
    std::optional<std::uint32_t> crossed(const Eigen::Vector3d& from,
                                         const Eigen::Vector3d& to) const;

    static constexpr double slack = 0.3;  ///< [m]

  private:
    struct Line {
        Eigen::Vector3d middle;  ///< world, `slack` behind the lane's end
        Eigen::Vector2d ahead;
        double half_width = 0;
        std::uint32_t lane = 0;
    };

    std::vector<Line> lines_;  ///< by lane
    BoxGrid grid_;
};

/// Must who faces it stop? Yellow does not say so: who cannot stop any more may drive on.
inline bool is_red(SignalColor color) {
    return color == SignalColor::red || color == SignalColor::red_yellow;
}

/// Did a vehicle run a red light? What counts is the light of the turning that it takes, at the
/// tick in which its front crosses the stop line. Where the lights of a lane's turnings differ it
/// is known only once the vehicle has turned so far that it can be on one of them alone.
class RedLightWatch {
  public:
    /// The vehicle at the next tick. `p_rear` and `yaw`: on the ground below the rear axle;
    /// `front`: [m] from there to the front bumper; `farthest`: [m] it can have driven since the
    /// last tick, what moved farther was put there.
    void observe(const TownT& town,
                 const StopLines& lines,
                 const TickView& tick,
                 const Eigen::Vector3d& p_rear,
                 double yaw,
                 double front,
                 double farthest);

    /// It was put elsewhere since it was observed: it has crossed nothing on the way there, and
    /// which turning it was about to take stays unknown.
    void lose_sight() {
        p_front_.reset();
        lane_ = none;
    }

    bool ran_red() const { return ran_red_; }

    /// Does it wait to see which way it takes?
    bool is_undecided() const { return lane_ != none; }

  private:
    void cross(const TownT& town, const TickView& tick, std::uint32_t lane);
    void decide(const TownT& town, const Eigen::Vector3d& p_rear, double yaw, double lead);

    std::optional<Eigen::Vector3d> p_front_;  ///< at the last tick
    bool ran_red_ = false;
    std::uint32_t lane_ = none;  ///< whose line was crossed, while it is undecided
    std::vector<bool> red_;      ///< [link of that lane]
};

}  // namespace reprise::world

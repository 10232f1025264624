#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "drivers/control/ego.h"
#include "drivers/road_map.h"
#include "drivers/way/way.h"
#include "world/digest.h"
#include "world/town.h"

namespace reprise::drivers {

/// Knows where the car is on its way, and keeps the way going: along what it is told, or wherever
/// the seed leads. Finds a way again for a car that was pushed off it.
class Navigator {
  public:
    /// Is there a way under the car?
    enum class Found : std::uint8_t {
        nothing,  ///< off every road
        same,
        another  ///< it was lost, or has just begun
    };

    /// `map` must outlive this. `step`: [s] of a tick; `comfortable_braking` [m/s^2].
    Navigator(const RoadMap& map,
              std::uint64_t seed,
              std::uint32_t actor,
              double step,
              double comfortable_braking);

    Navigator(const Navigator&) = delete;
    Navigator& operator=(const Navigator&) = delete;

    /// Lanes to pass in this order, the last one at `last_s` [m]. Planned by the next follow.
    void set_route(std::vector<std::uint32_t> stops, double last_s);

    /// To a lane beside the one that the car is on, by the next follow.
    void change_lane(std::uint32_t lane);

    /// To this lane at once, whatever is there: it is the way from the next follow on, which the
    /// car finds itself beside.
    void switch_lane(std::uint32_t lane);

    /// Stays on its lane from the next follow on, but for change_lane; or again as it likes.
    void keep_lane(bool keep);

    /// Brings the place on the way (and ego.rear_axle_s) up to date, and the way as far ahead as
    /// the car needs to brake, and more. The car is to be `beside` metres left of it. Throws
    /// world::Error naming a lane that cannot be reached.
    Found follow(Ego& ego, double beside = 0);

    /// [m] left of the way.
    double beside_way(const Ego& ego) const;

    /// The car was put elsewhere: at the next follow a way is looked for under it.
    void lose_way() { on_way_ = false; }

    /// A new way for one who has turned around, on the lane under it or else on `lane`.
    void start_on(std::uint32_t lane, Ego& ego);

    /// The next change of lanes begins `distance` [m] ahead of the front bumper, not before.
    void put_off_change(double distance, Ego& ego);

    const Way& way() const { return way_; }

    /// By how much distances along the way have grown since the last call: a way that starts anew
    /// is counted from there. [m]
    double take_jump() { return std::exchange(jump_, 0); }

    void add_to(world::Hasher& hasher) const;

  private:
    /// Given, not planned yet.
    struct NewRoute {
        std::vector<std::uint32_t> stops;
        double last_s = 0;
    };

    std::optional<std::uint32_t> lane_under(const Ego& ego) const;
    bool is_changing_lanes(const Ego& ego) const;
    bool is_lost(const Ego& ego, double beside) const;
    void start_over(Ego& ego, const std::vector<std::uint32_t>& lanes_ahead, double change_room);
    std::vector<std::uint32_t> committed_lanes(const Ego& ego) const;
    void require_way(std::uint32_t from, std::span<const std::uint32_t> stops, double last_s) const;
    void take_keeping(Ego& ego);
    void take_route(Ego& ego);
    void take_change(Ego& ego);

    const RoadMap* map_;
    Way way_;
    double step_;
    double comfortable_braking_;
    std::optional<NewRoute> new_route_;
    std::optional<std::uint32_t> new_lane_;
    bool new_lane_at_once_ = false;
    std::optional<bool> new_keeping_;
    double rear_axle_s_ = 0;  ///< only grows while the way stays
    double jump_ = 0;         ///< taken within the tick: not digested
    bool on_way_ = false;
};

}  // namespace reprise::drivers

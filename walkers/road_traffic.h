#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "walkers/road_users.h"
#include "world/town.h"

namespace reprise::walkers {

/// A place on a lane that somebody's way crosses.
struct Conflict {
    double at = 0;          ///< [m] along the way over the road
    double half_width = 0;  ///< [m] of what cars take up there, along that way

    /// A lane from which cars come there: `distance` [m] from its start. Negative on lanes behind
    /// the place, where the rear of a long car is still on it.
    struct Approach {
        std::uint32_t lane = 0;
        double distance = 0;
    };

    std::vector<Approach> approaches;
};

/// What somebody on foot expects of a car that can stop without pain: nothing; that it does when it
/// is slow or brakes already; that it will.
enum class Trust : std::uint8_t { none, seen, all };

/// When somebody is in the way of cars. [s] from now
struct Stay {
    double from = 0;
    double to = 0;
};

/// Who drives where, at a tick, as somebody sees it who wants to cross.
class RoadTraffic {
  public:
    /// They must outlive this.
    RoadTraffic(const world::TownT& town, const world::LaneMap& lanes);

    /// The lanes that a straight way over the road crosses, in its order. 50 us.
    std::vector<Conflict> conflicts(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

    /// Takes in those of them that are on a lane.
    void look(std::span<const RoadUser> users);

    /// Can somebody be in the way of cars that long? `around_standing`: what stands there is no
    /// hindrance, he goes around it. A car that waits for him with its nose in his way and he for
    /// the car would else wait for ever. Likewise around what has stood there for long.
    bool is_free(const Conflict& conflict, Stay stay, Trust trust, bool around_standing) const;

    /// Who has stood for long close before this place, not at a light: perhaps because people keep
    /// crossing. 0: nobody.
    std::uint32_t long_waiting(const Conflict& conflict) const;

    /// Has he yet to drive over this place?
    bool is_before(const Conflict& conflict, std::uint32_t id) const;

  private:
    struct Comer {
        std::uint32_t lane = 0;
        double s = 0;  ///< [m] of its front
        double speed = 0;
        double length = 0;
        double stood = 0;     ///< [s]
        bool yields = false;  ///< as far as one can see
        std::uint32_t id = 0;
    };

    std::span<const Comer> comers_on(std::uint32_t lane) const;
    void add_approaches(std::uint32_t lane, double distance, Conflict& conflict) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    std::vector<std::vector<std::uint32_t>> before_;  ///< [lane] lanes that lead onto it
    std::vector<std::vector<std::uint32_t>> behind_;  ///< [lane]
    std::vector<Comer> comers_;                       ///< by (lane, id)
};

}  // namespace reprise::walkers

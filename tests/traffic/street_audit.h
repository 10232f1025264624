#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "world/geometry2d.h"
#include "world/obstacle.h"
#include "world/story/crashes.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::test {

/// What happened in the streets of a run, told from its ticks alone: who went through whom, how
/// fast traffic was minute by minute, and of each collision who, where, whose fault as far as it
/// can be told, and whether an attentive driver could have avoided it.
///
/// MUST    find what is in what: cars in cars, walkers, props, walls; walkers in walls.
/// ASSUMES ticks in their order, each of them, with traffic.
/// GOES    by outlines in plan, of those less than 2.5 m apart in height.
/// KEEPS   six seconds of places, for the look back from a collision.
class StreetAudit {
  public:
    /// `town` and `walls` must outlive this. `step` [s] of a tick.
    StreetAudit(const world::TownT& town, std::span<const world::Obstacle> walls, double step);

    void see(const world::TickView& tick);

    /// After the last tick.
    void finish();

    /// One body in another, deeper than a touch, from its first tick to its last.
    struct Intrusion {
        std::uint32_t who = 0;
        std::uint32_t other = 0;  ///< 0: a wall
        std::string what;         ///< "car in walker"
        std::uint64_t first = 0;  ///< tick
        std::uint64_t last = 0;   ///< tick
        double depth = 0;         ///< [m] the deepest
        Eigen::Vector2d place{0, 0};
        std::string details;    ///< of the deepest: which lane, and which wall
        bool is_wreck = false;  ///< of a crash: pressed in, not driven through
    };

    struct Minute {
        double driven = 0;  ///< [m] by cars
        std::uint64_t car_ticks = 0;
        std::uint64_t cars = 0;      ///< seen all of it
        std::uint64_t standing = 0;  ///< of them moved less than 2 m
    };

    struct Collision {
        world::Crash crash;
        std::string lane;
        std::string fault;  ///< in words
        bool avoidable = false;
        double seen_for = 0;  ///< [s] that the other was in its way before
        double room = 0;      ///< [m] then
        double needed = 0;    ///< [m] to stop, a second of reaction and 6 m/s2
    };

    const std::vector<Intrusion>& intrusions() const { return intrusions_; }

    const std::vector<Minute>& minutes() const { return minutes_; }

    const std::vector<Collision>& collisions() const { return collisions_; }

    /// Half of those who were there all of it moved less than 2 m.
    static bool is_gridlock(const Minute& minute) {
        return minute.cars >= 10 && 2 * minute.standing > minute.cars;
    }

    /// All of it, for people.
    std::string text() const;

  private:
    enum class Kind : std::uint8_t { car, walker, prop };

    struct Body {
        std::uint32_t id = 0;
        Kind kind = Kind::car;
        Eigen::Vector2d middle{0, 0};
        Eigen::Vector2d ahead{1, 0};
        double half_length = 0;
        double half_width = 0;
        double z = 0;
        double speed = 0;  ///< [m/s] along `ahead`
        std::uint32_t lane = world::none;
        const char* model = "";
        bool has_mass = false;
    };

    static std::vector<Body> bodies_of(const world::TickView& tick);
    static double depth_of(const Body& one, const Body& other);
    void find_intrusions(std::span<const Body> bodies);
    void find_walls(const Body& body);
    void note(const Body& who,
              std::uint32_t other,
              const std::string& what,
              double depth,
              const std::string& details = {});
    std::string lane_of(const Body& body) const;
    void measure(std::span<const Body> bodies);
    void end_minute();
    void judge(const world::Crash& crash);
    const Body* find(std::size_t back, std::uint32_t id) const;
    bool is_wreck(std::uint32_t id, std::uint64_t tick) const;
    std::string fault_of(const Body& driver, const Body& other, std::uint64_t tick) const;

    const world::TownT* town_;
    std::span<const world::Obstacle> walls_;
    world::BoxGrid wall_grid_;
    double step_;
    std::uint64_t tick_ = 0;
    std::deque<std::vector<Body>> past_;  ///< the newest first, sorted by id
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> open_;  ///< in intrusions_
    std::map<std::uint32_t, double> way_;                                  ///< [m] in this minute
    std::map<std::uint32_t, std::uint64_t> last_red_;                      ///< tick
    std::map<std::uint32_t, std::uint64_t> wrecked_;                       ///< tick
    std::set<std::pair<std::uint32_t, std::uint32_t>> met_;  ///< who collided with whom
    world::CrashStory story_;
    std::vector<Intrusion> intrusions_;
    std::vector<Minute> minutes_;
    std::vector<Collision> collisions_;
};

}  // namespace reprise::test

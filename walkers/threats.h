#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "walkers/road_users.h"
#include "world/geometry2d.h"

namespace reprise::walkers {

/// Cars that are about to roll over somebody: a lorry's or a bus's rear cuts the corner that people
/// wait at, and not every driver brakes in time.
class Threats {
  public:
    /// Takes in those of them that roll.
    void look(std::span<const RoadUser> users);

    /// Where somebody comes who would go to a place close to him: walls and kerbs may be in his
    /// way.
    using Reach = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

    /// Which way somebody of that radius [m] at `p` gets out of the way of what comes within a
    /// second: across it, to his own side, unless he does not get there. None: nothing comes that
    /// close.
    std::optional<Eigen::Vector2d> way_out(const Eigen::Vector2d& p,
                                           double radius,
                                           const Reach& reach) const;
    std::optional<Eigen::Vector2d> way_out(const Eigen::Vector2d& p, double radius) const;

    /// [m] that he goes that way until another one, on that side, is nearer than the one that he
    /// gets away from: between the two he stands. Infinity: nothing comes there, or he would be hit
    /// wherever he stood.
    double to_between(const Eigen::Vector2d& p,
                      const Eigen::Vector2d& way,
                      double radius,
                      const Reach& reach) const;

    /// Does anything come that close to `p`? Then way_out(p) is one.
    bool come_near(const Eigen::Vector2d& p, double radius) const;

  private:
    struct Threat {
        Eigen::Vector2d middle;
        Eigen::Vector2d ahead;
        double rear = 0;  ///< [m] along `ahead`, of what the body passes over within a second
        double front = 0;
        double half_width = 0;
        world::Box around{};  ///< whoever is outside of it is out of its reach
    };

    template <typename See>
    void near(const Eigen::Vector2d& p, double reach, See&& see) const;
    double clearance(const Eigen::Vector2d& p) const;
    void add(const RoadUser& car);
    void add_box(const RoadUser& car, double rear, double front);

    /// A threat by the western edge of its surroundings.
    struct Key {
        double west = 0;  ///< [m]
        std::uint32_t index = 0;

        auto operator<=>(const Key&) const = default;
    };

    void sort();

    std::vector<Threat> threats_;  ///< in the order of the road users
    std::vector<Key> keys_;        ///< of them, sorted
    double widest_ = 0;            ///< [m] of their surroundings, from west to east
};

}  // namespace reprise::walkers

#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "walkers/steering.h"

namespace reprise::walkers {

/// Everybody around, as round bodies, found by place. Bodies may move a little after they were
/// sorted: less than `drift`. And posts, which never move.
class Neighbours {
  public:
    static constexpr double drift = 0.5;  ///< [m]

    /// Whom one keeps away from, besides others on foot.
    struct From {
        bool cars = false;
        bool posts = false;
    };

    void clear() { added_.clear(); }

    void add_posts(std::span<const Body> posts);

    /// `of_car`: only who is on the road keeps away from it.
    std::size_t add(const Body& body, bool of_car);

    /// By place. Behind it nobody is added.
    void sort();

    /// Of a body by what add() returned for it; behind sort().
    std::size_t index_of(std::size_t added) const { return index_[added]; }

    void move(std::size_t index, const Eigen::Vector2d& place) {
        bodies_[index].body.place = place;
    }

    /// Those within `reach` of `self`, the nearest first, without `self` itself.
    void around(const Body& self, double reach, From from, std::vector<Body>& found) const;

    /// May `self` move to `to`: is nobody met there whom it was clear of, and nobody pushed?
    bool is_clear(const Body& self, const Eigen::Vector2d& to, From from) const;

  private:
    struct Entry {
        Body body;
        double x = 0;  ///< [m] when it was sorted
        bool of_car = false;
    };

    template <typename Visit>
    void visit(const Body& self, double reach, From from, Visit&& see) const;

    /// Small, for sorting.
    struct Key {
        double x = 0;
        std::uint32_t id = 0;
        std::uint32_t index = 0;  ///< as it was added

        auto operator<=>(const Key&) const = default;
    };

    std::vector<Entry> added_;          ///< as they were added
    std::vector<Key> keys_;             ///< of them
    std::vector<Entry> bodies_;         ///< by (x, id)
    std::vector<std::uint32_t> index_;  ///< [as it was added] in bodies_
    double widest_ = 0;                 ///< [m] radius
    std::vector<Body> posts_;           ///< by x
    double widest_post_ = 0;            ///< [m] radius
};

}  // namespace reprise::walkers

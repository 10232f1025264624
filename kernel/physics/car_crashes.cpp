#include <algorithm>

#include "kernel/physics/near_cars.h"
#include "world/tick.h"

namespace reprise::kernel {

namespace {

/// [m] Of two cars' reference points in x: two of 12 m, and what they drive in a tick.
constexpr double farthest = 30;

/// A car, and how it goes through the tick.
struct Moving {
    std::uint32_t id = 0;
    PlacedBox from;
    PlacedBox to;
    bool moves = false;

    PlacedBox after(double share) const { return {between(from.pose, to.pose, share), from.half}; }

    double way() const { return (to.pose.getOrigin() - from.pose.getOrigin()).length(); }
};

bool is_scripted(std::uint32_t id) {
    return id < world::first_background_id;
}

/// Sorted by x.
std::vector<Moving> all_on_their_way(std::span<const world::CarState> last,
                                     std::span<const world::CarState> next,
                                     const Displaced& displaced) {
    std::vector<Moving> cars;
    for (const world::CarState& car : next) {
        const world::CarState* before =
            holds(displaced, car.id()) ? nullptr : world::find(last, car.id());
        const PlacedBox to = box_of(car);
        cars.push_back({car.id(), before != nullptr ? box_of(*before) : to, to, false});
        if (cars.back().way() > NearCars::longest_move)
            cars.back().from = to;
        cars.back().moves = cars.back().way() > 0;
    }
    std::sort(cars.begin(), cars.end(), [](const Moving& one, const Moving& other) {
        return std::make_pair(one.to.pose.getOrigin().x(), one.id) <
               std::make_pair(other.to.pose.getOrigin().x(), other.id);
    });
    return cars;
}

/// Fast ones would be through a bicycle between two ticks.
bool meet(const Moving& one, const Moving& other) {
    if (!one.moves && !other.moves)
        return false;
    const double room = one.from.half.length() + one.way() + other.from.half.length() + other.way();
    if (one.to.pose.getOrigin().distance2(other.to.pose.getOrigin()) > room * room)
        return false;
    for (const double share : {0.25, 0.5, 0.75, 1.0})
        if (gap_between(one.after(share), other.after(share)) < -deepest_scrape)
            return true;
    return false;
}

}  // namespace

CarCrashes crashes_among(std::span<const world::CarState> last,
                         std::span<const world::CarState> next,
                         const Displaced& displaced) {
    CarCrashes crashes;
    if (next.empty() || !is_scripted(next.front().id()))
        return crashes;
    const std::vector<Moving> cars = all_on_their_way(last, next, displaced);
    for (const Moving& car : cars) {
        if (!is_scripted(car.id))
            continue;
        const double x = car.to.pose.getOrigin().x();
        auto other = std::lower_bound(
            cars.begin(), cars.end(), x - farthest, [](const Moving& each, double low) {
                return each.to.pose.getOrigin().x() < low;
            });
        for (; other != cars.end() && other->to.pose.getOrigin().x() <= x + farthest; ++other) {
            const bool is_pair = other->id > car.id;  // of two scripted ones once
            if (is_pair && meet(car, *other))
                crashes.emplace_back(car.id, other->id);
        }
    }
    std::sort(crashes.begin(), crashes.end());
    return crashes;
}

}  // namespace reprise::kernel

#include "towns/buildings/rectangular_site.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::BuildingModel;

constexpr double fullest = 0.92;                     ///< share of the rectangle, at least
constexpr double smallest = 0.6, largest = 1.5;      ///< of what a model is made for
constexpr double most_upright = 0.8;                 ///< length over depth, at least
constexpr double low_reach = 1.2, high_reach = 1.3;  ///< [m] of porches; of balconies

/// The least rectangle with a side along one of the outline's, x along that side.
Footprint enclosing(const world::Loop& outline) {
    Footprint best;
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2d side = outline[(i + 1) % outline.size()] - outline[i];
        if (side.norm() < 0.05)
            continue;
        const Vector2d along = side.normalized();
        const Vector2d across(-along.y(), along.x());
        world::Box box;
        for (const Vector2d& p : outline)
            box.take({p.dot(along), p.dot(across)});
        const Vector2d size = box.high - box.low;
        if (size.x() * size.y() >= least)
            continue;
        least = size.x() * size.y();
        const Vector2d middle = (box.low + box.high) / 2;
        best = {along * middle.x() + across * middle.y(),
                std::atan2(along.y(), along.x()),
                size.x(),
                size.y()};
    }
    return best;
}

Vector2d backwards(const Footprint& f) {
    return {-std::sin(f.yaw), std::cos(f.yaw)};
}

/// What lies before the front, this deep.
Footprint before(const Footprint& f, double depth) {
    return {f.centre - backwards(f) * (f.width + depth) / 2, f.yaw, f.length, depth};
}

bool is_within(double size, double least, double most) {
    return size >= smallest * least && size <= largest * most;
}

bool can_take(const BuildingModel& model, const Footprint& f) {
    return is_within(f.length, model.shortest, model.longest) &&
           is_within(f.width, model.shallowest, model.deepest) &&
           f.length >= most_upright * f.width;
}

/// May what is built onto the front stand out of it?
bool has_room(const BuildingModel& model, const Footprint& f, const Streets& streets) {
    constexpr auto low = world::part_porch | world::part_bays;
    constexpr auto high = world::part_balconies | world::part_awning | world::part_fire_escape;
    if ((model.parts & (low | high)) != 0 && !streets.roads.is_clear(before(f, high_reach), 0))
        return false;
    return (model.parts & low) == 0 || streets.walks.is_clear(before(f, low_reach), 0);
}

}  // namespace

Streets::Streets(const world::TownT& town) {
    for (const world::LaneT& lane : town.lanes)
        if (world::is_for_cars(lane))
            roads.add_line(lane.centre, lane.width / 2);
        else if (lane.kind == world::LaneKind::sidewalk)
            walks.add_line(lane.centre, lane.width / 2);
}

std::optional<RectangularSite> rectangular_site(const world::Loop& outline,
                                                const Streets& streets) {
    Footprint around = enclosing(outline);
    const double share =
        std::abs(world::signed_area(outline)) / std::max(1e-6, around.length * around.width);
    if (share < fullest)
        return std::nullopt;
    around.length *= std::sqrt(share);
    around.width *= std::sqrt(share);
    // A corner that was cut off for a sidewalk would be there again.
    if (!streets.roads.is_clear(around, 0) || !streets.walks.is_clear(around, 0))
        return std::nullopt;
    RectangularSite site;
    for (std::size_t i = 0; i < 4; ++i) {
        site.fronts[i] = around;
        const Vector2d middle = around.centre - backwards(around) * around.width / 2;
        site.to_street[i] = streets.roads.of(middle);
        // The next side to the right becomes the front.
        around = {around.centre, around.yaw + 0.5 * std::numbers::pi, around.width, around.length};
    }
    return site;
}

std::optional<Footprint> fit(const BuildingModel& model,
                             const RectangularSite& site,
                             const Streets& streets) {
    // By centimetres, so that equal sides are equal; the longer one then.
    const auto rank = [&](std::size_t i) {
        return std::pair(std::llround(100 * site.to_street[i]),
                         -std::llround(100 * site.fronts[i].length));
    };
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        return rank(i) < rank(j);
    });
    for (const std::size_t i : order) {
        Footprint f = site.fronts[i];
        if (!can_take(model, f))
            continue;
        if (has_room(model, f, streets))
            return f;
        f.centre += backwards(f) * high_reach / 2;
        f.width -= high_reach;
        return can_take(model, f) ? std::optional(f) : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace reprise::towns

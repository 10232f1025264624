#include "towns/check/things_in_town.h"

#include "towns/check/criterion.h"

namespace reprise::towns {

namespace {

using Thing = ThingsInTown::Thing;

constexpr double headroom = 4.0;      ///< [m] over a lane; what begins higher up is no obstacle
constexpr double trunk_radius = 0.3;  ///< [m]

world::Loop rectangle(const world::Vec3& centre, double yaw, double length, double width) {
    const Eigen::Vector2d along = world::ahead_of(yaw) * length / 2;
    const Eigen::Vector2d across = world::left_of(yaw) * width / 2;
    const Eigen::Vector2d middle = world::in_plan(centre);
    return {middle - along - across,
            middle + along - across,
            middle + along + across,
            middle - along + across};
}

/// Do people walk and drive around its pole only?
bool is_on_a_pole(world::PropKind kind) {
    switch (kind) {
        case world::PropKind::speed_limit_sign:
        case world::PropKind::stop_sign:
        case world::PropKind::yield_sign:
        case world::PropKind::crossing_sign:
        case world::PropKind::street_light:
        case world::PropKind::pole:
            return true;
        default:
            return false;
    }
}

void add_buildings(const world::TownT& town, std::vector<Thing>& standing) {
    for (std::size_t i = 0; i < town.buildings.size(); ++i) {
        const world::Building& b = town.buildings[i];
        const double low = b.centre().z();
        standing.push_back({numbered("building", i),
                            rectangle(b.centre(), b.yaw(), b.length(), b.width()),
                            0,
                            low,
                            low + b.height()});
    }
    for (std::size_t i = 0; i < town.drawn_buildings.size(); ++i) {
        const world::DrawnBuildingT& b = town.drawn_buildings[i];
        const double low = b.outline.empty() ? 0 : b.outline[0].z();
        standing.push_back(
            {numbered("drawn building", i), world::in_plan(b.outline), 0, low, low + b.height});
    }
}

void add_furniture(const world::TownT& town, std::vector<Thing>& standing) {
    const auto add_round =
        [&](std::string name, const world::Vec3& foot, double radius, double height) {
            standing.push_back(
                {std::move(name), {world::in_plan(foot)}, radius, foot.z(), foot.z() + height});
        };
    for (std::size_t i = 0; i < town.trees.size(); ++i)
        add_round(
            numbered("plant", i), town.trees[i].position(), trunk_radius, town.trees[i].height());
    for (std::size_t i = 0; i < town.heads.size(); ++i)
        add_round(
            numbered("signal head", i), town.heads[i].foot, pole_radius, town.heads[i].height);
    for (std::size_t i = 0; i < town.props.size(); ++i) {
        const world::Prop& prop = town.props[i];
        const std::string name = numbered(EnumNamePropKind(prop.kind()), i);
        const double low = prop.position().z();
        if (is_on_a_pole(prop.kind()))
            add_round(name, prop.position(), pole_radius, prop.height());
        else
            standing.push_back({name,
                                rectangle(prop.position(), prop.yaw(), prop.length(), prop.width()),
                                0,
                                low,
                                low + prop.height()});
    }
}

}  // namespace

ThingsInTown::ThingsInTown(const world::TownT& town) {
    add_buildings(town, things_);
    add_furniture(town, things_);
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < things_.size(); ++i)
        if (!things_[i].loop.empty())
            entries.push_back({world::box_around(things_[i].loop, things_[i].radius), i});
    by_place_ = world::BoxGrid(entries);
}

bool ThingsInTown::is_on_level(const Thing& thing, double road) {
    return thing.low < road + headroom && thing.high > road;
}

/// Do they overlap? Its border runs through the loop, or one lies within the other.
bool ThingsInTown::touch(const Thing& thing, const world::Loop& loop) {
    if (world::contains(loop, thing.loop[0]))
        return true;
    for (std::size_t i = 0; i < loop.size(); ++i)
        if (world::distance_to(thing.loop, loop[i], loop[(i + 1) % loop.size()]) <= thing.radius)
            return true;
    return false;
}

}  // namespace reprise::towns

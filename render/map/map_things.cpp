#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "render/map/map_layers.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using world::PropKind;

constexpr std::array<Ink, 6> roof_inks{{{203, 158, 134},
                                        {191, 170, 150},
                                        {181, 175, 172},
                                        {214, 192, 160},
                                        {184, 146, 128},
                                        {168, 164, 170}}};
constexpr std::array<Ink, 3> plant_inks{{{122, 168, 98}, {138, 178, 106}, {108, 154, 92}}};
constexpr Ink vehicle_ink{84, 104, 150};

struct Roof {
    world::Loop outline;
    double height = 0;
    std::uint32_t style = 0;
};

world::Loop rectangle(const world::Vec3& centre, double yaw, double length, double width) {
    const Eigen::Vector2d along = Eigen::Vector2d(std::cos(yaw), std::sin(yaw)) * length / 2;
    const Eigen::Vector2d across = Eigen::Vector2d(-std::sin(yaw), std::cos(yaw)) * width / 2;
    const Eigen::Vector2d middle = world::in_plan(centre);
    return {middle - along - across,
            middle + along - across,
            middle + along + across,
            middle - along + across};
}

std::vector<Roof> roofs_of(const world::TownT& town) {
    std::vector<Roof> roofs;
    for (const world::Building& b : town.buildings)
        roofs.push_back(
            {rectangle(b.centre(), b.yaw(), b.length(), b.width()), b.height(), b.style()});
    for (const world::DrawnBuildingT& b : town.drawn_buildings)
        roofs.push_back({world::in_plan(b.outline), b.height, b.style});
    return roofs;
}

/// What a building of this height throws on the land, with the sun in the north-west as on maps:
/// one quadrilateral for each wall.
void add_shadow(const Roof& roof, std::vector<world::Loop>& shadows) {
    const double reach = std::min(0.22 * roof.height, 9.0);  // [m]
    const Eigen::Vector2d away(reach, -reach);
    for (std::size_t i = 0; i < roof.outline.size(); ++i) {
        const Eigen::Vector2d& from = roof.outline[i];
        const Eigen::Vector2d& to = roof.outline[(i + 1) % roof.outline.size()];
        shadows.push_back({from, to, to + away, from + away});
    }
}

/// Shown as what it covers; none: too small for a map.
std::optional<Ink> ink_of(PropKind kind) {
    switch (kind) {
        case PropKind::fence:
        case PropKind::wall:
            return Ink{140, 128, 112};
        case PropKind::hedge:
            return Ink{104, 146, 88};
        case PropKind::bench:
        case PropKind::table:
            return Ink{150, 112, 80};
        case PropKind::bus_stop:
            return Ink{64, 120, 176};
        case PropKind::parked_vehicle:
            return vehicle_ink;
        case PropKind::fountain:
            return Ink{120, 180, 214};
        case PropKind::swing:
            return Ink{206, 130, 70};
        default:
            return std::nullopt;
    }
}

/// Discs read alike in pixels, whatever the scale; never larger than `metres` unless too small to
/// see.
double readable(double metres, double least_pixels, double most_pixels, const MapCanvas& canvas) {
    return std::clamp(metres * canvas.pixels_per_metre(),
                      least_pixels * canvas.unit(),
                      most_pixels * canvas.unit());
}

void draw_sign(const world::Prop& sign, MapCanvas& canvas) {
    const Eigen::Vector2d place = world::in_plan(sign.position());
    const double radius = readable(1.0, 2.2, 5.5, canvas);
    constexpr Ink red{200, 40, 44};
    if (sign.kind() == PropKind::stop_sign) {
        canvas.disc(place, radius, red);
        canvas.symbol(place,
                      0,
                      {{-radius * 0.6, -radius * 0.2},
                       {radius * 0.6, -radius * 0.2},
                       {radius * 0.6, radius * 0.2},
                       {-radius * 0.6, radius * 0.2}},
                      white);
    } else if (sign.kind() == PropKind::yield_sign) {
        canvas.symbol(
            place, 0, {{-radius, radius * 0.8}, {radius, radius * 0.8}, {0, -radius}}, red);
        canvas.symbol(
            place,
            0,
            {{-radius * 0.5, radius * 0.5}, {radius * 0.5, radius * 0.5}, {0, -radius * 0.5}},
            white);
    } else {
        canvas.disc(place, radius, red);
        canvas.disc(place, 0.62 * radius, white);
    }
}

bool is_sign(PropKind kind) {
    return kind == PropKind::speed_limit_sign || kind == PropKind::stop_sign ||
           kind == PropKind::yield_sign;
}

}  // namespace

void draw_buildings(const world::TownT& town, MapCanvas& canvas) {
    const std::vector<Roof> roofs = roofs_of(town);
    std::vector<world::Loop> shadows;
    for (const Roof& roof : roofs)
        add_shadow(roof, shadows);
    canvas.shade(shadows, 0.84);
    for (const Roof& roof : roofs) {
        const Ink ink = roof_inks[roof.style % roof_inks.size()];
        canvas.fill(roof.outline, ink);
        if (canvas.pixels_per_metre() > 0.9 * canvas.unit())
            canvas.line(roof.outline, 0.8 * canvas.unit(), ink.times(0.72), true);
    }
}

void draw_plants(const world::TownT& town, MapCanvas& canvas) {
    for (const world::Tree& tree : town.trees) {
        const Eigen::Vector2d place = world::in_plan(tree.position());
        const double radius = std::max(tree.crown_radius() * canvas.pixels_per_metre(), 0.6);
        const Ink ink = plant_inks[tree.style() % plant_inks.size()];
        canvas.disc(place, radius, ink.times(0.86));
        const Eigen::Vector2d lit(-0.14 * tree.crown_radius(), 0.14 * tree.crown_radius());
        canvas.disc(place + lit, 0.76 * radius, ink.times(1.06));
    }
}

void draw_furniture(const world::TownT& town, MapCanvas& canvas) {
    for (const world::Prop& prop : town.props) {
        const auto ink = ink_of(prop.kind());
        if (ink) {
            const double least = 0.8 / canvas.pixels_per_metre();  // [m]
            canvas.fill(rectangle(prop.position(),
                                  prop.yaw(),
                                  std::max(prop.length(), least),
                                  std::max(prop.width(), least)),
                        *ink);
        } else if (prop.kind() == PropKind::street_light) {
            canvas.disc(
                world::in_plan(prop.position()), readable(0.35, 0.7, 2, canvas), {240, 190, 70});
        } else if (is_sign(prop.kind())) {
            draw_sign(prop, canvas);
        }
    }
}

void draw_spawn_points(const world::TownT& town, MapCanvas& canvas) {
    for (const world::SpawnPoint& point : town.spawn_points) {
        const Eigen::Vector2d place = world::in_plan(point.position());
        if (point.for_walkers()) {
            canvas.disc(place, readable(0.5, 1.1, 2.6, canvas), {226, 120, 40});
            continue;
        }
        const double reach = readable(1.5, 2.2, 5.5, canvas);
        canvas.symbol(place,
                      point.yaw(),
                      {{reach, 0}, {-0.8 * reach, 0.7 * reach}, {-0.8 * reach, -0.7 * reach}},
                      {40, 96, 200});
    }
}

void draw_signals(const world::TownT& town, MapCanvas& canvas) {
    const auto draw = [&](const Eigen::Vector2d& place, double yaw, bool for_walkers) {
        const double r = readable(0.8, 1.5, 3.2, canvas);
        // A housing, lying so that its red end is farthest from those who look at it.
        const double half = for_walkers ? 2 * r : 3 * r;
        canvas.symbol(place,
                      yaw,
                      {{half, r * 1.15}, {-half, r * 1.15}, {-half, -r * 1.15}, {half, -r * 1.15}},
                      {36, 38, 42});
        const Eigen::Vector2d along =
            Eigen::Vector2d(std::cos(yaw), std::sin(yaw)) / canvas.pixels_per_metre();
        canvas.disc(place + along * (half - r), 0.8 * r, {228, 60, 50});
        if (!for_walkers)
            canvas.disc(place, 0.8 * r, {240, 190, 50});
        canvas.disc(place - along * (half - r), 0.8 * r, {60, 180, 90});
    };
    // Without heads, where the signals are known to be.
    if (town.heads.empty())
        for (const world::SignalT& signal : town.signals)
            draw(world::in_plan(signal.position), signal.yaw, signal.for_walkers);
    for (const world::SignalHeadT& head : town.heads)
        draw(world::in_plan(head.foot), head.yaw, head.for_walkers);
}

}  // namespace reprise::render

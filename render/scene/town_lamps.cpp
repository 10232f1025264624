#include "render/scene/town_lamps.h"

#include <cmath>

#include "render/shapes/buildings/openings.h"
#include "render/shapes/noise.h"
#include "render/shapes/street/prop_mesh.h"
#include "render/shapes/street/signal_parts.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3f flat(double yaw) {
    return {static_cast<float>(std::cos(yaw)), static_cast<float>(std::sin(yaw)), 0};
}

/// As add_street_light() builds them.
TownLamps::StreetLight street_light(const world::Prop& prop, const Vector3d& origin) {
    const Vector3f foot = (world::to_eigen(prop.position()) - origin).cast<float>();
    const PropSize size = size_of(prop);
    if (size.height < 5)
        return {foot + Vector3f(0, 0, size.height - 0.35F), true};
    const float arm = std::max(0.6F, size.length);
    return {foot + arm * flat(prop.yaw()) + Vector3f(0, 0, size.height - 0.15F), false};
}

/// As add_signal_heads() builds it.
TownLamps::Head head_of(const world::TownT& town,
                        const world::SignalHeadT& head,
                        const Vector3d& origin) {
    const Vector3f ahead = flat(head.yaw);
    const Vector3f left(-ahead.y(), ahead.x(), 0);
    const float height = signal_case_height(head.for_walkers);
    const Vector3f foot = (world::to_eigen(head.foot) - origin).cast<float>();
    return {foot - (signal_pole + 0.12F) * ahead + static_cast<float>(head.arm) * left +
                Vector3f(0, 0, static_cast<float>(head.height) + 0.5F * height),
            -ahead,
            height,
            main_signal(town, head.signals),
            head.for_walkers};
}

void add_shop_windows(std::vector<TownLamps::ShopWindow>& windows,
                      const Wall& wall,
                      const BuildingPaint& paint) {
    if (wall.use != WallUse::front || !paint.has(world::part_shop_front))
        return;
    const Vector3f outwards = wall.along.cross(Vector3f::UnitZ());
    for (int column = 0; column < wall.columns; ++column) {
        const float middle =
            wall.length * (static_cast<float>(column) + 0.5F) / static_cast<float>(wall.columns);
        const Opening opening = opening_at(wall, paint, middle, 1.5F);
        if (opening.kind != OpeningKind::shop)
            continue;
        windows.push_back({wall.foot + middle * wall.along +
                               Vector3f(0, 0, 0.5F * (opening.low + opening.high)) +
                               0.3F * outwards,
                           outwards,
                           (opening.right - opening.left) * (opening.high - opening.low),
                           unit(hash(opening.seed, 2))});
    }
}

}  // namespace

TownLamps::TownLamps(const world::TownT& town, const Facades& facades, const Vector3d& origin) {
    for (const world::Prop& prop : town.props)
        if (prop.kind() == world::PropKind::street_light)
            street_lights.push_back(street_light(prop, origin));
    for (const world::SignalHeadT& head : town.heads)
        if (!head.signals.empty())
            heads.push_back(head_of(town, head, origin));
    for (const Wall& wall : facades.walls)
        add_shop_windows(shop_windows, wall, facades.buildings[wall.building]);
}

}  // namespace reprise::render

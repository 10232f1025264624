#include <cmath>

#include "render/shapes/builder.h"
#include "render/shapes/street/signal_parts.h"
#include "world/frames.h"
#include "world/town.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// Which way a signal's link turns; straight where the town does not say.
world::Turn turn_of(const world::TownT& town, std::uint32_t signal) {
    const std::uint32_t lane =
        signal < town.signals.size() ? town.signals[signal].lane : world::none;
    if (lane >= town.lanes.size())
        return world::Turn::straight;
    for (const world::Link& link : town.lanes[lane].links)
        if (link.signal() == signal)
            return link.turn();
    return world::Turn::straight;
}

bool is_left(world::Turn turn) {
    return turn == world::Turn::left || turn == world::Turn::partially_left ||
           turn == world::Turn::around;
}

/// An arrow that points to the left (`way` 1) or right (-1) of those who face it; `at` is its
/// middle.
void add_arrow(Builder& build, const Vector3f& at, float size, float way, Finish finish) {
    const auto corner = [&](float along, float up) {
        return Vector3f(at + size * Vector3f(0, way * along, up));
    };
    const auto triangle = [&](const Vector3f& p, const Vector3f& q, const Vector3f& r) {
        if (way > 0)
            build.triangle({p, q, r}, finish);
        else
            build.triangle({p, r, q}, finish);
    };
    triangle(corner(.85F, 0), corner(.05F, -.72F), corner(.05F, .72F));
    triangle(corner(.05F, .26F), corner(.05F, -.26F), corner(-.8F, -.26F));
    triangle(corner(.05F, .26F), corner(-.8F, -.26F), corner(-.8F, .26F));
}

/// A lamp for a turn, beside the case's lowest one: a lit arrow on black, so that nobody takes it
/// for another green for all.
void add_turn_lamp(Mesh& mesh,
                   const Eigen::Isometry3f& frame,
                   float arm,
                   float way,
                   float bottom,
                   std::uint32_t signal) {
    constexpr float radius = 0.10F;
    const float y = arm + way * .34F;
    Builder build(mesh, frame);
    build.box({.03F, y - .15F, bottom}, {.20F, y + .15F, bottom + .32F}, {Material::signal_case});
    add_signal_lamp(mesh, frame, {.02F, y, bottom + .16F}, radius, {Material::signal_case});
    add_arrow(build,
              {-.015F, y, bottom + .16F},
              radius,
              way,
              {Material::signal_lamp, 4 * signal + static_cast<std::uint32_t>(SignalLamp::turn)});
}

void add_head(Mesh& mesh,
              const world::TownT& town,
              const world::SignalHeadT& head,
              const Eigen::Vector3d& origin) {
    Eigen::Isometry3f frame = Eigen::Isometry3f::Identity();
    frame.linear() =
        Eigen::AngleAxisf(static_cast<float>(head.yaw), Vector3f::UnitZ()).toRotationMatrix();
    // The pole stands on the foot, the lamps before it.
    frame.translation() = (world::to_eigen(head.foot) - origin).cast<float>();
    frame.translation() -= frame.linear() * Vector3f(signal_pole, 0, 0);
    const auto arm = static_cast<float>(head.arm);
    const auto middle = static_cast<float>(head.height);
    const float half = 0.5F * signal_case_height(head.for_walkers);
    const float top = middle + half;
    const std::uint32_t shown = main_signal(town, head.signals);
    const bool reaches = std::abs(arm) > 0.45F;
    add_signal_pole(mesh, frame, 0, reaches ? middle + 0.15F : top + 0.05F);
    if (reaches)
        add_tube(mesh,
                 {frame * Vector3f(signal_pole, 0, middle),
                  frame * Vector3f(signal_pole, arm, middle + 0.12F),
                  .065F,
                  .042F,
                  10},
                 {Material::pole});
    else
        Builder(mesh, frame)
            .box({.18F, arm - .03F, middle - .03F},
                 {.32F, arm + .03F, middle + .03F},
                 {Material::signal_case});
    add_signal_case(mesh, frame, arm, top, shown, head.for_walkers);
    if (head.for_walkers)
        return;
    bool left_taken = false;
    bool right_taken = false;
    for (const std::uint32_t signal : head.signals) {
        const bool left = is_left(turn_of(town, signal));
        bool& taken = left ? left_taken : right_taken;
        if (signal == shown || taken)
            continue;
        taken = true;
        add_turn_lamp(mesh, frame, arm, left ? 1.0F : -1.0F, top - 2 * half, signal);
    }
}

}  // namespace

std::uint32_t main_signal(const world::TownT& town, const std::vector<std::uint32_t>& signals) {
    for (const std::uint32_t signal : signals)
        if (turn_of(town, signal) == world::Turn::straight)
            return signal;
    return signals.front();
}

void add_signal_head(Mesh& mesh,
                     const world::TownT& town,
                     const world::SignalHeadT& head,
                     const Eigen::Vector3d& origin) {
    if (!head.signals.empty())
        add_head(mesh, town, head, origin);
}

}  // namespace reprise::render

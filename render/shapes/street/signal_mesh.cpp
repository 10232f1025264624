#include <cmath>
#include <numbers>

#include "render/shapes/street/signal_parts.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// x: driving direction of those who face the signal, y: to their left, origin on the ground.
Eigen::Isometry3f signal_frame(const world::SignalT& signal, const Eigen::Vector3d& origin) {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.linear() =
        Eigen::AngleAxisf(static_cast<float>(signal.yaw), Vector3f::UnitZ()).toRotationMatrix();
    const Eigen::Vector3d position(signal.position.x(), signal.position.y(), signal.position.z());
    pose.translation() = (position - origin).cast<float>();
    return pose;
}

/// Metres from the lane's middle to the pole beside the outermost lane for cars, left positive.
float pole_offset(const world::TownT& town, const world::LaneT& lane) {
    const double side = town.left_hand ? 1 : -1;
    double offset = lane.width / 2;
    const world::LaneT* at = &lane;
    for (int guard = 0; guard < 16; ++guard) {
        const std::uint32_t next = town.left_hand ? at->left : at->right;
        if (next == world::none || !world::is_for_cars(town.lanes[next]))
            break;
        at = &town.lanes[next];
        offset += at->width;
    }
    return static_cast<float>(side * (offset + 0.6));
}

void add_car_signal(Mesh& mesh,
                    const world::TownT& town,
                    std::uint32_t index,
                    const Eigen::Vector3d& origin) {
    const world::SignalT& signal = town.signals[index];
    const Eigen::Isometry3f frame = signal_frame(signal, origin);
    if (signal.lane == world::none) {
        add_signal_pole(mesh, frame, -2.4F, 3.5F);
        add_signal_case(mesh, frame, -2.4F, 3.45F, index, false);
        return;
    }
    const world::LaneT& lane = town.lanes[signal.lane];
    const float pole = pole_offset(town, lane);
    const bool beside = std::abs(pole) < static_cast<float>(lane.width / 2 + 0.7);
    if (beside) {
        add_signal_pole(mesh, frame, pole, 3.5F);
        add_signal_case(mesh, frame, pole, 3.45F, index, false);
        return;
    }
    // An inner lane: the head hangs above it on an arm.
    add_signal_pole(mesh, frame, pole, 6.0F);
    add_tube(mesh,
             {frame * Vector3f(.3F, pole, 5.9F), frame * Vector3f(.3F, 0, 6.0F), .06F, .04F, 10},
             {Material::pole});
    add_signal_case(mesh, frame, 0, 6.25F, index, false);
}

}  // namespace

float signal_case_height(bool for_walkers) {
    const float radius = for_walkers ? 0.085F : 0.115F;
    return radius * 2.75F * (for_walkers ? 2 : 3) + 0.06F;
}

void add_signal_pole(Mesh& mesh, const Eigen::Isometry3f& frame, float y, float height) {
    const Finish pole{Material::pole};
    add_tube(mesh,
             {frame * Vector3f(.3F, y, -.1F), frame * Vector3f(.3F, y, height), .07F, .055F, 12},
             pole);
    add_tube(mesh,
             {frame * Vector3f(.3F, y, -.1F), frame * Vector3f(.3F, y, .5F), .11F, .10F, 12},
             pole);
}

void add_signal_lamp(
    Mesh& mesh, const Eigen::Isometry3f& frame, const Vector3f& at, float radius, Finish lamp) {
    const Vector3f out(-1, 0, 0);
    add_tube(
        mesh, {frame * at, frame * Vector3f(at + .025F * out), radius, radius * 0.9F, 16}, lamp);
    // Visor: a half tube above the lamp.
    std::vector<std::vector<Vector3f>> rings(4);
    for (int i = 0; i <= 10; ++i) {
        const double angle = std::numbers::pi * (i / 10.0 * 1.1 - 0.05);
        const Vector3f across(0,
                              static_cast<float>(std::cos(angle)) * radius * 1.12F,
                              static_cast<float>(std::sin(angle)) * radius * 1.12F);
        const Vector3f far = 0.16F * out;
        rings[0].push_back(frame * Vector3f(at + across));
        rings[1].push_back(frame * Vector3f(at + across + far));
        rings[2].push_back(frame * Vector3f(at + 1.08F * across + far));
        rings[3].push_back(frame * Vector3f(at + 1.08F * across));
    }
    add_loft(mesh, rings, false, {Material::signal_case});
}

void add_signal_case(Mesh& mesh,
                     const Eigen::Isometry3f& frame,
                     float y,
                     float top,
                     std::uint32_t signal,
                     bool for_walkers) {
    const float radius = for_walkers ? 0.085F : 0.115F;
    const float step = radius * 2.75F;
    const int lamps = for_walkers ? 2 : 3;
    Eigen::Isometry3f middle = frame;
    const float half = step * static_cast<float>(lamps) * 0.5F + 0.03F;
    middle.translation() = frame * Vector3f(.12F, y, top - half);
    add_box(mesh, middle, {.10F, radius * 1.45F, half}, {Material::signal_case});
    if (!for_walkers) {
        middle.translation() = frame * Vector3f(.2F, y, top - half);
        add_box(mesh, middle, {.012F, radius * 2.5F, half + 0.12F}, {Material::signal_case});
    }
    for (int i = 0; i < lamps; ++i) {
        const SignalLamp lamp = i == 0           ? SignalLamp::red
                                : i + 1 == lamps ? SignalLamp::green
                                                 : SignalLamp::yellow;
        const float z = top - 0.03F - step * (static_cast<float>(i) + 0.5F);
        add_signal_lamp(mesh,
                        frame,
                        {.02F, y, z},
                        radius,
                        {Material::signal_lamp, 4 * signal + static_cast<std::uint32_t>(lamp)});
    }
}

void add_signal(Mesh& mesh,
                const world::TownT& town,
                std::uint32_t number,
                const Eigen::Vector3d& origin) {
    const world::SignalT& signal = town.signals[number];
    if (signal.for_walkers) {
        const Eigen::Isometry3f frame = signal_frame(signal, origin);
        add_signal_pole(mesh, frame, 0.9F, 2.65F);
        add_signal_case(mesh, frame, 0.9F, 2.6F, number, true);
        return;
    }
    for (std::uint32_t other = 0; other < number; ++other)
        if (signal.lane != world::none && !town.signals[other].for_walkers &&
            town.signals[other].lane == signal.lane)
            return;
    add_car_signal(mesh, town, number, origin);
}

}  // namespace reprise::render

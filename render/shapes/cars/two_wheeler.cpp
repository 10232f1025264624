#include "render/shapes/cars/two_wheeler.h"

#include <cmath>
#include <numbers>

#include "render/shapes/cars/car_parts.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

bool is_bicycle(const CarShape& shape) {
    return shape.style == world::BodyStyle::bicycle;
}

void rod(Mesh& mesh, const Vector3f& from, const Vector3f& to, float radius, CarPart part) {
    add_tube(mesh, {from, to, radius, radius, 8}, part_finish(part));
}

/// The same on the other side.
void rods(Mesh& mesh, const Vector3f& from, const Vector3f& to, float radius, CarPart part) {
    rod(mesh, from, to, radius, part);
    const Vector3f mirror(1, -1, 1);
    rod(mesh, from.cwiseProduct(mirror), to.cwiseProduct(mirror), radius, part);
}

void blob(Mesh& mesh, const Vector3f& centre, const Vector3f& radii, CarPart part) {
    add_ellipsoid(mesh, centre, radii, 16, part_finish(part));
}

void box(Mesh& mesh, const Vector3f& centre, const Vector3f& half, CarPart part) {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.translation() = centre;
    add_box(mesh, pose, half, part_finish(part));
}

void add_bicycle(Mesh& mesh, const CarShape& shape) {
    const float r = shape.wheel_radius();
    const float base = shape.wheelbase();
    const Vector3f bottom(0.43F, 0, 0.28F);
    const Vector3f seat(0.27F, 0, 0.80F);
    const Vector3f head_low(base - 0.14F, 0, 0.66F);
    const Vector3f head_high(base - 0.19F, 0, 0.83F);
    constexpr CarPart frame = CarPart::painted;
    rod(mesh, bottom, seat, .017F, frame);
    rod(mesh, bottom, head_low, .02F, frame);
    rod(mesh, seat, head_high, .017F, frame);
    rods(mesh, {0, .055F, r}, bottom + Vector3f(0, .03F, 0), .010F, frame);
    rods(mesh, {0, .055F, r}, seat + Vector3f(0, .02F, -.03F), .009F, frame);
    rod(mesh, head_low, head_high, .022F, frame);
    rod(mesh, seat, {.245F, 0, .885F}, .013F, CarPart::chrome);
    blob(mesh, {.21F, 0, .90F}, {.13F, .075F, .035F}, CarPart::leather);
    blob(mesh, {.30F, 0, .90F}, {.10F, .03F, .025F}, CarPart::leather);
    // Chain ring, mudguard with the rear lamp, luggage carrier.
    add_tube(mesh,
             {bottom + Vector3f(0, -.05F, 0), bottom + Vector3f(0, -.04F, 0), .095F, .095F, 20},
             part_finish(CarPart::chrome));
    rod(mesh, {-.175F, 0, .735F}, {.24F, 0, .74F}, .012F, CarPart::rubber);
    for (const float x : {-.12F, .04F, .20F})
        rod(mesh, {x, -.055F, .74F}, {x, .055F, .74F}, .006F, CarPart::rubber);
    rods(mesh, {-.16F, .05F, .74F}, {.22F, .05F, .74F}, .008F, CarPart::rubber);
    rods(mesh, {0, .06F, r}, {-.03F, .06F, .74F}, .006F, CarPart::rubber);
    box(mesh, {-.18F, 0, .71F}, {.015F, .035F, .025F}, CarPart::rear_lamp);
}

void add_motorcycle(Mesh& mesh, const CarShape& shape) {
    const float r = shape.wheel_radius();
    const float base = shape.wheelbase();
    // Engine, exhaust, swing arm.
    box(mesh, {.62F, 0, .42F}, {.20F, .15F, .13F}, CarPart::rubber);
    blob(mesh, {.74F, 0, .57F}, {.12F, .13F, .14F}, CarPart::chrome);
    rods(mesh, {0, .10F, r}, {.50F, .10F, .40F}, .03F, CarPart::rubber);
    rod(mesh, {.80F, -.12F, .33F}, {.40F, -.16F, .30F}, .028F, CarPart::chrome);
    rod(mesh, {.40F, -.17F, .30F}, {-.12F, -.19F, .40F}, .055F, CarPart::chrome);
    // Tank, saddle, tail, fairing.
    blob(mesh, {.76F, 0, .86F}, {.29F, .155F, .14F}, CarPart::painted);
    blob(mesh, {.38F, 0, .78F}, {.32F, .14F, .075F}, CarPart::leather);
    blob(mesh, {.02F, 0, .86F}, {.28F, .11F, .08F}, CarPart::painted);
    blob(mesh, {base - .46F, 0, .64F}, {.24F, .17F, .20F}, CarPart::painted);
    rods(mesh, {.44F, .12F, .36F}, {.44F, .22F, .34F}, .014F, CarPart::chrome);
    // Rear mudguard, lamp, indicators, plate.
    box(mesh, {-.22F, 0, .70F}, {.03F, .09F, .10F}, CarPart::rubber);
    box(mesh, {-.255F, 0, .84F}, {.02F, .09F, .03F}, CarPart::rear_lamp);
    blob(mesh, {-.24F, .15F, .78F}, {.035F, .03F, .025F}, CarPart::left_indicator);
    blob(mesh, {-.24F, -.15F, .78F}, {.035F, .03F, .025F}, CarPart::right_indicator);
    rod(mesh, {-.22F, -.14F, .78F}, {-.22F, .14F, .78F}, .008F, CarPart::rubber);
}

}  // namespace

Seat seat_of(const CarShape& shape) {
    const double base = static_cast<double>(shape.wheelbase());
    if (is_bicycle(shape))
        return {{.20, 0, .95}, {base - .30, .25, 1.03}, {.43, .11, .28}, .17, .42};
    return {{.36, 0, .86}, {base - .42, .33, 1.04}, {.46, .19, .35}, 0, .22};
}

Mesh two_wheeler_mesh(const CarShape& shape) {
    Mesh mesh;
    if (is_bicycle(shape))
        add_bicycle(mesh, shape);
    else
        add_motorcycle(mesh, shape);
    drop_degenerate(mesh);
    smooth(mesh, 1.0);
    return mesh;
}

Mesh fork_mesh(const CarShape& shape) {
    Mesh mesh;
    const float r = shape.wheel_radius();
    const bool bicycle = is_bicycle(shape);
    // Relative to the front axle's foot: the fork leans back.
    const Vector3f top = bicycle ? Vector3f(-.20F, .05F, .87F) : Vector3f(-.30F, .10F, .92F);
    rods(mesh,
         {0, bicycle ? .05F : .10F, r},
         top,
         bicycle ? .012F : .027F,
         bicycle ? CarPart::painted : CarPart::chrome);
    const Vector3f grip(bicycle ? -.28F : -.40F, bicycle ? .22F : .28F, bicycle ? 1.00F : 1.02F);
    const Vector3f stem(top.x(), 0, bicycle ? .98F : 1.0F);
    rod(mesh, {top.x(), 0, top.z() - .04F}, stem, .018F, CarPart::chrome);
    rods(mesh, stem, grip, .012F, CarPart::chrome);
    rods(mesh, grip, grip + Vector3f(-.03F, .10F, 0), .017F, CarPart::rubber);
    const Vector3f lamp = bicycle ? Vector3f(-.10F, 0, .84F) : Vector3f(-.14F, 0, .86F);
    const float size = bicycle ? .035F : .085F;
    blob(mesh, lamp, {size * .8F, size, size}, CarPart::rubber);
    blob(mesh,
         lamp + Vector3f(.02F, 0, 0),
         {size * .8F, size * .9F, size * .9F},
         CarPart::front_lamp);
    if (bicycle) {
        rod(mesh, {top.x(), 0, .84F}, lamp, .008F, CarPart::rubber);
    } else {
        blob(mesh, {-.18F, 0, 1.0F}, {.07F, .17F, .13F}, CarPart::window);
        blob(mesh, {0, 0, r + .24F}, {.22F, .075F, .06F}, CarPart::painted);  // mudguard
        blob(mesh, {-.18F, .19F, .86F}, {.035F, .03F, .025F}, CarPart::left_indicator);
        blob(mesh, {-.18F, -.19F, .86F}, {.035F, .03F, .025F}, CarPart::right_indicator);
        rods(mesh, grip, {-.36F, .31F, 1.17F}, .007F, CarPart::chrome);
        blob(mesh, {-.36F, .31F, 1.19F}, {.015F, .06F, .035F}, CarPart::rubber);
        blob(mesh, {-.36F, -.31F, 1.19F}, {.015F, .06F, .035F}, CarPart::rubber);
    }
    drop_degenerate(mesh);
    smooth(mesh, 1.0);
    return mesh;
}

Mesh thin_wheel_mesh(const CarShape& shape) {
    Mesh mesh;
    const bool bicycle = is_bicycle(shape);
    const float tyre = bicycle ? .020F : .055F;
    const auto ring = [&](float radius, float thick, float wide, CarPart part) {
        std::vector<std::vector<Vector3f>> rings;
        for (int i = 0; i <= 40; ++i) {
            const double turn = 2 * std::numbers::pi * i / 40;
            std::vector<Vector3f>& around = rings.emplace_back();
            for (int k = 0; k < 8; ++k) {
                const double angle = 2 * std::numbers::pi * k / 8;
                const float out = radius + thick * static_cast<float>(std::cos(angle));
                around.emplace_back(out * static_cast<float>(std::cos(turn)),
                                    wide * static_cast<float>(std::sin(angle)),
                                    out * static_cast<float>(std::sin(turn)));
            }
        }
        add_loft(mesh, rings, true, part_finish(part));
    };
    ring(shape.wheel_radius() - tyre, tyre, bicycle ? .020F : .06F, CarPart::rubber);
    const float rim = shape.wheel_radius() - 2.1F * tyre;
    ring(rim, bicycle ? .010F : .02F, bicycle ? .013F : .045F, CarPart::chrome);
    rod(mesh, {0, -.05F, 0}, {0, .05F, 0}, bicycle ? .02F : .05F, CarPart::chrome);
    const int spokes = bicycle ? 18 : 7;
    for (int i = 0; i < spokes; ++i) {
        const double turn = 2 * std::numbers::pi * i / spokes;
        const Vector3f out(
            static_cast<float>(std::cos(turn)), 0, static_cast<float>(std::sin(turn)));
        const float side = bicycle ? (i % 2 == 0 ? .035F : -.035F) : 0;
        rod(mesh,
            Vector3f(0, side, 0) + .015F * out,
            rim * out,
            bicycle ? .0022F : .016F,
            bicycle ? CarPart::chrome : CarPart::rubber);
    }
    if (!bicycle)  // brake disc
        add_tube(
            mesh, {{0, .055F, 0}, {0, .062F, 0}, .14F, .14F, 24}, part_finish(CarPart::chrome));
    drop_degenerate(mesh);
    smooth(mesh, 1.0);
    return mesh;
}

Mesh crank_mesh(const CarShape& shape) {
    Mesh mesh;
    const auto length = static_cast<float>(seat_of(shape).crank);
    rod(mesh, {0, 0, 0}, {0, 0, -length}, .011F, CarPart::chrome);
    box(mesh, {0, .05F, -length}, {.045F, .045F, .012F}, CarPart::rubber);
    drop_degenerate(mesh);
    smooth(mesh, 1.0);
    return mesh;
}

double lean_angle(double speed, double yaw_rate) {
    constexpr double gravity = 9.81;
    return std::clamp(std::atan2(speed * yaw_rate, gravity), -0.8, 0.8);
}

Eigen::Isometry3d leaning_pose(const world::VehicleState& vehicle) {
    const Eigen::Isometry3d pose = world::pose(vehicle.position(), vehicle.orientation());
    const bool fell = pose.linear()(2, 2) < 0.7;
    if (fell)
        return pose;
    const Eigen::Vector3d ahead = pose.linear().col(0);
    const double yaw = std::atan2(ahead.y(), ahead.x());
    const double pitch = std::atan2(ahead.z(), ahead.head<2>().norm());
    const double lean =
        lean_angle(world::to_eigen(vehicle.velocity()).dot(ahead), vehicle.angular_velocity().z());
    return world::pose(vehicle.position(), yaw, pitch) *
           Eigen::AngleAxisd(-lean, Eigen::Vector3d::UnitX());
}

}  // namespace reprise::render

#include "render/shapes/people/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/shapes/noise.h"
#include "render/shapes/people/body.h"
#include "render/shapes/people/carried.h"
#include "render/shapes/people/posture.h"
#include "world/check.h"

namespace reprise::render {

namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using world::Clothing;

/// The shortest turn from the z axis to a unit vector. Eigen's FromTwoVectors gives the same bits,
/// but for straight down, where its singular value decomposition takes seven seconds to compile.
Eigen::Quaterniond turn_from_up(const Vector3d& target) {
    const double cosine = target.z();
    if (cosine < -1 + 1e-12)
        return {0, 1, 0, 0};  // half a turn about x
    const double twice_w = std::sqrt((1 + cosine) * 2);
    const double scale = 1 / twice_w;
    return {twice_w * 0.5, -target.y() * scale, target.x() * scale, 0};
}

Affine3d stretched_bone(const Vector3d& from, const Vector3d& to, double radius) {
    const Vector3d axis = to - from;
    Affine3d pose = Affine3d::Identity();
    const Eigen::Quaterniond turn = turn_from_up(axis.normalized());
    pose.linear() =
        turn.toRotationMatrix() * Eigen::DiagonalMatrix<double, 3>(radius, radius, axis.norm());
    pose.translation() = from;
    return pose;
}

Affine3d stretched_ball(const Vector3d& centre, const Vector3d& radii) {
    Affine3d pose = Affine3d::Identity();
    pose.linear() = radii.asDiagonal();
    pose.translation() = centre;
    return pose;
}

/// What legs and arms are clad in.
struct Cover {
    Material thigh, shank, upper_arm, forearm;
};

Cover cover_of(Clothing clothing, const Outfit& outfit) {
    const Material leg = outfit.stockings ? Material::trousers : Material::skin;
    const Material arm = outfit.short_sleeves ? Material::skin : Material::shirt;
    switch (clothing) {
        case Clothing::shorts:
            return {Material::trousers, Material::skin, Material::shirt, arm};
        case Clothing::skirt:
        case Clothing::dress:
            return {leg, leg, Material::shirt, arm};
        case Clothing::gown:
            return {Material::trousers, Material::trousers, Material::shirt, Material::shirt};
        default:
            return {Material::trousers, Material::trousers, Material::shirt, arm};
    }
}

void add_leg(std::vector<FigurePart>& parts,
             const Posture& posture,
             const BodyProportions& body,
             const Cover& cover,
             std::size_t side) {
    const double h = body.height * body.stoutness;
    const double out = side == 0 ? 1 : -1;
    const Vector3d hip = posture.hip + Vector3d(0, out * body.half_hip, 0);
    const Vector3d ankle = posture.ankle(body, side);
    const Vector3d knee =
        joint_between(hip, ankle, body.thigh, body.thigh, Vector3d(1, 0.08 * out, 0));
    const bool loose = cover.shank == Material::trousers;
    parts.push_back(
        {FigurePart::Shape::bone, cover.thigh, stretched_bone(hip, knee, thigh_radius(body))});
    parts.push_back({FigurePart::Shape::bone,
                     cover.shank,
                     stretched_bone(knee, ankle, (loose ? .040 : .036) * h)});
    Affine3d shoe = Affine3d::Identity();
    shoe.translation() = posture.toe[side];
    shoe.rotate(Eigen::AngleAxisd(posture.pitch[side], Vector3d::UnitY()));
    shoe.scale(body.foot);
    parts.push_back({FigurePart::Shape::shoe, Material::shoe, shoe});
}

void add_arm(std::vector<FigurePart>& parts,
             const Posture& posture,
             const BodyProportions& body,
             const Cover& cover,
             std::size_t side) {
    const double h = body.height * body.stoutness;
    const double out = side == 0 ? 1 : -1;
    const Vector3d shoulder = posture.shoulder(body, side) - Vector3d(0, 0, 0.012 * h);
    const Vector3d& wrist = posture.wrist[side];
    const Vector3d elbow =
        joint_between(shoulder, wrist, body.upper_arm, body.forearm, Vector3d(-1, 0.5 * out, -0.3));
    const Vector3d along = (wrist - elbow).normalized();
    parts.push_back({FigurePart::Shape::ball,
                     cover.upper_arm,
                     stretched_ball(shoulder, Vector3d::Constant(.033 * h))});
    parts.push_back(
        {FigurePart::Shape::bone, cover.upper_arm, stretched_bone(shoulder, elbow, .0315 * h)});
    parts.push_back(
        {FigurePart::Shape::bone, cover.forearm, stretched_bone(elbow, wrist, .025 * h)});
    parts.push_back(
        {FigurePart::Shape::bone,
         Material::skin,
         stretched_bone(wrist - 0.004 * h * along, wrist + .085 * body.height * along, .020 * h)});
}

/// Where body_parts() puts the thighs; shank and shoe follow each.
constexpr std::size_t first_leg = 1, second_leg = 8;

std::vector<FigurePart> body_parts(const world::WalkerModel& model,
                                   const BodyProportions& body,
                                   const Posture& posture,
                                   const Outfit& outfit) {
    std::vector<FigurePart> parts;
    const Cover cover = cover_of(model.clothing, outfit);
    parts.push_back({FigurePart::Shape::trunk, Material::skin, Affine3d(posture.trunk())});
    for (const std::size_t side : {0U, 1U}) {
        add_leg(parts, posture, body, cover, side);
        add_arm(parts, posture, body, cover, side);
    }
    return parts;
}

/// What a hem must hold: a point of a leg's skin, seen from the hips, and the hem's size there.
struct Held {
    double x, y, z;
    HemSize size;
};

/// Of the legs among these parts as far down as the hem goes.
std::vector<Held> held_by_hem(const world::WalkerModel& model,
                              const Posture& posture,
                              const std::vector<FigurePart>& parts) {
    static const std::array<Mesh, 3> meshes{bone_mesh(), bone_mesh(), shoe_mesh()};
    const double low = -hem_length(model);
    const Hem hem(model);
    std::vector<Held> held;
    for (const std::size_t leg : {first_leg, second_leg})
        for (std::size_t part = 0; part < meshes.size(); ++part)
            for (const Eigen::Vector3f& vertex : meshes[part].vertices) {
                const Vector3d p = parts[leg + part].pose * vertex.cast<double>() - posture.hip;
                if (p.z() > low && p.z() < 0)
                    held.push_back({p.x(), p.y(), p.z(), hem.at(p.z())});
            }
    return held;
}

/// It gives way to the legs: swings with them as a whole, and is wider while they are apart.
FigurePart hem(const world::WalkerModel& model,
               const Posture& posture,
               const std::vector<FigurePart>& parts) {
    constexpr double room = 0.93;   // of an ellipse for the polygon in it
    constexpr double aside = 0.80;  // share of the half width where legs also have depth
    const std::vector<Held> held = held_by_hem(model, posture, parts);
    double front = 0, back = 0, wide = 1, deep = 1;
    for (const Held& p : held)
        if (p.z < -0.5 * hem_length(model)) {
            front = std::max(front, -p.x / p.z);
            back = std::min(back, -p.x / p.z);
        }
    const double swing = 0.5 * (front + back);  // [m] ahead for each metre down
    for (const Held& p : held)
        wide = std::max(wide, std::abs(p.y) / (aside * p.size.width));
    for (const Held& p : held) {
        const double across = p.y / (wide * p.size.width);
        deep = std::max(
            deep, std::abs(p.x + swing * p.z) / (p.size.depth * std::sqrt(room - across * across)));
    }
    Affine3d pose(Eigen::Translation3d(posture.hip));
    pose.linear() << deep, 0, -swing, 0, wide, 0, 0, 0, 1;
    return {FigurePart::Shape::hem, Material::shirt, pose};
}

}  // namespace

std::uint32_t appearance_bits(const world::WalkerState& walker) {
    return walker.look() != 0 ? walker.look() : hash(walker.id(), 1);
}

bool umbrellas_are_open(const world::TickView& tick) {
    const world::Weather* weather = tick.tick->weather();
    return weather != nullptr && weather->rain() > 0;
}

std::vector<FigurePart> figure(const world::WalkerModel& model,
                               const world::WalkerState& walker,
                               bool rains) {
    const BodyProportions body(model);
    const std::uint32_t look = appearance_bits(walker);
    const Outfit outfit = outfit_of(model, look);
    const auto speed = static_cast<double>(walker.speed());
    const bool walks = speed > 0.05 && !walker.down();
    Posture posture = walks ? striding(model, speed, static_cast<double>(walker.phase()))
                            : standing(model, hash(look, 40));
    if (!walker.down())
        hold(posture, body, outfit.carried, rains);
    std::vector<FigurePart> parts = body_parts(model, body, posture, outfit);
    if (hem_length(model) > 0)
        parts.push_back(hem(model, posture, parts));
    if (!walker.down()) {
        add_carried(parts, posture, body, outfit.carried, rains);
        return parts;
    }
    Affine3d lying = Affine3d::Identity();
    lying.linear() = Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitY()).toRotationMatrix();
    lying.translation() = Vector3d(model.height / 2, 0, 0.13);
    for (FigurePart& part : parts)
        part.pose = lying * part.pose;
    return parts;
}

std::vector<FigurePart> rider(const CarShape& shape,
                              const Outfit& outfit,
                              double steering,
                              double crank) {
    const world::WalkerModel& model = rider_of(shape.style);
    const BodyProportions body(model);
    const Seat seat = seat_of(shape);
    Posture posture;
    posture.hip = seat.saddle + Vector3d(0, 0, 0.05 * body.height);
    posture.lean = seat.lean;
    const Vector3d axle(static_cast<double>(shape.wheelbase()), 0, 0);
    for (const std::size_t side : {0U, 1U}) {
        const Vector3d mirror(1, side == 0 ? 1 : -1, 1);
        const double angle = crank + (side == 0 ? 0 : std::numbers::pi);
        const Vector3d pedal = seat.foot.cwiseProduct(mirror) -
                               seat.crank * Vector3d(std::sin(angle), 0, std::cos(angle));
        posture.pitch[side] = seat.crank > 0 ? 0.15 - 0.25 * std::cos(angle) : 0.1;
        posture.toe[side] = pedal + Vector3d(0.3 * body.foot, 0, 0.01);
        const Vector3d grip = seat.grip.cwiseProduct(mirror) - axle;
        const Vector3d turned = axle + Eigen::AngleAxisd(steering, Vector3d::UnitZ()) * grip;
        // The wrist is behind the hand.
        posture.wrist[side] = turned - Vector3d(0.045 * body.height, 0, -0.012 * body.height);
    }
    return body_parts(model, body, posture, outfit);
}

const world::WalkerModel& rider_of(world::BodyStyle style) {
    static constexpr world::WalkerModel motorcyclist{"motorcyclist",
                                                     1.77,
                                                     0.47,
                                                     80,
                                                     1.3,
                                                     0.92,
                                                     world::Age::adult,
                                                     Clothing::uniform,
                                                     world::Hair::helmet};
    static constexpr world::WalkerModel cyclist{"cyclist",
                                                1.75,
                                                0.45,
                                                72,
                                                1.3,
                                                0.82,
                                                world::Age::adult,
                                                Clothing::casual,
                                                world::Hair::helmet};
    return style == world::BodyStyle::motorcycle ? motorcyclist : cyclist;
}

Mesh figure_part_mesh(FigurePart::Shape shape, const world::WalkerModel& model) {
    switch (shape) {
        case FigurePart::Shape::trunk:
            return trunk_mesh(model);
        case FigurePart::Shape::hem:
            return hem_mesh(model);
        case FigurePart::Shape::ball:
            return ball_mesh();
        case FigurePart::Shape::bone:
            return bone_mesh();
        case FigurePart::Shape::shoe:
            return shoe_mesh();
        default:
            return thing_mesh(shape);
    }
}

}  // namespace reprise::render

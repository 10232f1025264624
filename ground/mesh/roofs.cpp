#include "ground/mesh/roofs.h"

#include <algorithm>
#include <cmath>

#include "world/geometry2d.h"
#include "world/hash.h"

namespace reprise::ground {

namespace {

using Eigen::Vector2d;

constexpr double usual_pitch = 0.6;  // rise over run
constexpr double highest_hip = 5;    // [m]
constexpr std::size_t most_corners = 8;

/// The line of a side; `inward` is its unit normal.
struct RoofSide {
    Vector2d from;
    Vector2d along;
    Vector2d inward;

    double distance(const Vector2d& p) const { return inward.dot(p - from); }
};

float mix(float from, float to, float share) {
    return from + (to - from) * share;
}

/// None: not convex, or with a corner of less than some 40 degrees.
std::vector<RoofSide> sides_of(const world::Loop& outline) {
    constexpr double sharpest = -0.77;  // cosine of the turn at a corner
    if (outline.size() < 3 || outline.size() > most_corners)
        return {};
    std::vector<RoofSide> sides;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2d along = (outline[(i + 1) % outline.size()] - outline[i]).normalized();
        sides.push_back({outline[i], along, {-along.y(), along.x()}});
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const RoofSide& next = sides[(i + 1) % sides.size()];
        if (world::cross(sides[i].along, next.along) <= 1e-3 ||
            sides[i].along.dot(next.along) < sharpest)
            return {};
    }
    return sides;
}

/// The outline with every side moved outwards.
world::Loop widened(const std::vector<RoofSide>& sides, double by) {
    world::Loop loop;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const RoofSide& last = sides[(i + sides.size() - 1) % sides.size()];
        const RoofSide& next = sides[i];
        // The corner moves along both sides alike.
        const double share = by / world::cross(last.along, next.along);
        loop.push_back(next.from + share * (last.along - next.along));
    }
    return loop;
}

/// What of a convex loop is nearer to one side than to another one.
world::Loop nearer_to(const RoofSide& side, const RoofSide& other, const world::Loop& loop) {
    world::Loop kept;
    const auto excess = [&](const Vector2d& p) { return other.distance(p) - side.distance(p); };
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vector2d& p = loop[i];
        const Vector2d& q = loop[(i + 1) % loop.size()];
        const double at_p = excess(p);
        const double at_q = excess(q);
        if (at_p >= 0)
            kept.push_back(p);
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
            kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return kept;
}

}  // namespace

std::uint32_t building_seed(std::uint32_t style) {
    return world::hash(style, 0x5eedu);
}

float roof_rise(const world::BuildingModel& model, float x, float y, std::uint32_t seed) {
    const float narrow = std::min(x, y);
    const float draw = world::unit(world::hash(seed, 21));
    switch (model.roof) {
        case world::RoofKind::gabled:
            // Wide halls have flatter roofs.
            return y > 6.5F ? y * mix(0.42F, 0.55F, draw) : y * mix(0.72F, 0.98F, draw);
        case world::RoofKind::hipped:
            return narrow * mix(0.50F, 0.66F, draw);
        case world::RoofKind::mansard:
            return 3.4F;
        case world::RoofKind::shed:
            return 2 * y * mix(0.10F, 0.18F, draw);
        case world::RoofKind::sawtooth:
            return 2.4F;
        case world::RoofKind::spire:
            return y * mix(0.95F, 1.15F, draw);
        case world::RoofKind::dome:
        case world::RoofKind::flat:
            return 0;
    }
    return 0;
}

float tower_half(float half_width) {
    return std::min(half_width * 0.46F, 3.2F);
}

float spire_rise(const world::BuildingModel& model, float half_width) {
    const bool large = (model.parts & world::part_clock) != 0;
    return (large ? 5.5F : 2.5F) + 0.2F + tower_half(half_width) * (large ? 4.2F : 3.0F);
}

std::vector<std::vector<Eigen::Vector3d>> hipped_faces(const world::Loop& outline,
                                                       double overhang) {
    const std::vector<RoofSide> sides = sides_of(outline);
    if (sides.empty())
        return {};
    const world::Loop wide = widened(sides, overhang);
    std::vector<world::Loop> plans;
    double deepest = 0;  // [m] from the nearest side
    for (const RoofSide& side : sides) {
        world::Loop plan = wide;
        for (const RoofSide& other : sides)
            if (&other != &side)
                plan = nearer_to(side, other, plan);
        for (const Vector2d& p : plan)
            deepest = std::max(deepest, side.distance(p));
        plans.push_back(std::move(plan));
    }
    const double pitch = std::min(usual_pitch, highest_hip / deepest);
    std::vector<std::vector<Eigen::Vector3d>> faces;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        std::vector<Eigen::Vector3d> face;
        for (const Vector2d& p : plans[i]) {
            const Eigen::Vector3d corner(p.x(), p.y(), pitch * sides[i].distance(p));
            // Several slopes meet in a point: it comes once from each.
            if (face.empty() ||
                ((corner - face.back()).norm() > 1e-6 && (corner - face.front()).norm() > 1e-6))
                face.push_back(corner);
        }
        if (face.size() >= 3)
            faces.push_back(std::move(face));
    }
    return faces;
}

double hipped_rise(const world::Loop& outline) {
    double highest = 0;
    for (const auto& face : hipped_faces(outline, 0))
        for (const Eigen::Vector3d& p : face)
            highest = std::max(highest, p.z());
    return highest;
}

}  // namespace reprise::ground

#include "ground/mesh/ribbon.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::ground {

namespace {

using Line = std::vector<Eigen::Vector3d>;

constexpr double shortest_segment = 0.01;  ///< [m]
/// 1 + cosine of the sharpest turn with a full mitre, 120 degrees; sharper ones would reach far
/// out.
constexpr double shortest_mitre = 0.5;

Eigen::Vector2d flat(const Eigen::Vector3d& p) {
    return p.head<2>();
}

/// Unit vector to the left of the segment that starts at `from`, in plan.
Eigen::Vector2d left_normal(const Line& line, std::size_t from) {
    const Eigen::Vector2d along = flat(line[from + 1]) - flat(line[from]);
    return world::turned_left(along) / along.norm();
}

Eigen::Vector3d beside(const Eigen::Vector3d& p, const Eigen::Vector2d& normal, double offset) {
    return {p.x() + offset * normal.x(), p.y() + offset * normal.y(), p.z()};
}

double corner_area(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r) {
    return world::cross(flat(q) - flat(p), flat(r) - flat(p)) / 2;
}

bool is_proper(const std::vector<Eigen::Vector3d>& quad) {
    constexpr double least = 1e-6;  // [m2]
    return corner_area(quad[0], quad[1], quad[2]) > least &&
           corner_area(quad[0], quad[2], quad[3]) > least;
}

/// The outside of a bend, from one normal counter-clockwise to another, `offset` metres along them:
/// one wedge, in hairpins several, whose chords keep their distance.
void add_wedges(const Eigen::Vector3d& corner,
                const Eigen::Vector2d& first,
                const Eigen::Vector2d& last,
                double offset,
                std::vector<std::vector<Eigen::Vector3d>>& pieces) {
    constexpr double sharp = 75 * std::numbers::pi / 180;  // [rad]
    const double turn = std::atan2(world::cross(first, last), first.dot(last));
    const int count = turn > sharp ? 4 : 1;
    Eigen::Vector2d from = first;
    for (int i = 1; i <= count; ++i) {
        const Eigen::Vector2d to =
            i == count ? last : Eigen::Vector2d(Eigen::Rotation2Dd(turn * i / count) * first);
        pieces.push_back({corner, beside(corner, from, offset), beside(corner, to, offset)});
        from = to;
    }
}

/// Straight pieces with square ends, and a wedge on the outside of every bend: no folds, whatever
/// the line does.
std::vector<std::vector<Eigen::Vector3d>> square_pieces(const Line& line,
                                                        double right,
                                                        double left) {
    std::vector<std::vector<Eigen::Vector3d>> pieces;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector2d normal = left_normal(line, i);
        pieces.push_back({beside(line[i], normal, right),
                          beside(line[i + 1], normal, right),
                          beside(line[i + 1], normal, left),
                          beside(line[i], normal, left)});
        if (i + 2 == line.size())
            break;
        const Eigen::Vector2d next = left_normal(line, i + 1);
        const bool turns_left = world::cross(normal, next) > 0;
        if (turns_left && right < 0)
            add_wedges(line[i + 1], normal, next, right, pieces);
        if (!turns_left && left > 0)
            add_wedges(line[i + 1], next, normal, left, pieces);
    }
    return pieces;
}

/// Does it turn by more than 120 degrees? There cut-off mitres make the ribbon too narrow.
bool has_hairpin(const Line& line) {
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
        if (1 + left_normal(line, i - 1).dot(left_normal(line, i)) < shortest_mitre)
            return true;
    return false;
}

}  // namespace

std::vector<world::Loop> Ribbon::loops() const {
    std::vector<world::Loop> result;
    if (simple) {
        world::Loop loop;
        for (const Eigen::Vector3d& p : right)
            loop.push_back(flat(p));
        for (auto p = left.rbegin(); p != left.rend(); ++p)
            loop.push_back(flat(*p));
        result.push_back(std::move(loop));
        return result;
    }
    for (const auto& piece : pieces) {
        world::Loop loop;
        for (const Eigen::Vector3d& p : piece)
            loop.push_back(flat(p));
        result.push_back(std::move(loop));
    }
    return result;
}

Line clean_line(const std::vector<world::Vec3>& line, double overlap) {
    Line clean;
    for (const world::Vec3& point : line) {
        const Eigen::Vector3d p = world::to_eigen(point);
        if (clean.empty() || (flat(p) - flat(clean.back())).norm() >= shortest_segment)
            clean.push_back(p);
    }
    // The last point stands, whatever was dropped before it.
    if (clean.size() > 1)
        clean.back() = world::to_eigen(line.back());
    if (clean.size() > 2 &&
        (flat(clean[clean.size() - 2]) - flat(clean.back())).norm() < shortest_segment)
        clean.erase(clean.end() - 2);
    if (clean.size() < 2)
        clean = {clean.empty() ? Eigen::Vector3d::Zero() : clean[0],
                 (clean.empty() ? Eigen::Vector3d::Zero() : clean[0]) +
                     shortest_segment * Eigen::Vector3d::UnitX()};
    const auto lengthen = [&](Eigen::Vector3d& end, const Eigen::Vector3d& before) {
        const Eigen::Vector3d along = end - before;
        end += along * (overlap / flat(along).norm());
    };
    const Line points = clean;
    lengthen(clean.front(), points[1]);
    lengthen(clean.back(), points[points.size() - 2]);
    return clean;
}

Line with_more_points(const Line& line, double spacing) {
    Line dense{line[0]};
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector3d along = line[i + 1] - line[i];
        const int count = std::max(1, static_cast<int>(std::ceil(along.norm() / spacing)));
        for (int k = 1; k < count; ++k)
            dense.push_back(line[i] + along * (static_cast<double>(k) / count));
        dense.push_back(line[i + 1]);
    }
    return dense;
}

Line moved_left(const Line& line, double offset) {
    Line moved;
    moved.reserve(line.size());
    for (std::size_t i = 0; i < line.size(); ++i) {
        const Eigen::Vector2d before = left_normal(line, i > 0 ? i - 1 : 0);
        const Eigen::Vector2d after = left_normal(line, i + 1 < line.size() ? i : i - 1);
        // (before + after) / (1 + before . after) reaches the corner where both sides meet.
        const Eigen::Vector2d mitre =
            (before + after) / std::max(shortest_mitre, 1 + before.dot(after));
        moved.push_back(beside(line[i], mitre, offset));
    }
    return moved;
}

Ribbon make_ribbon(const Line& line, double right, double left) {
    Ribbon ribbon;
    ribbon.left = moved_left(line, left);
    ribbon.right = moved_left(line, right);
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        ribbon.pieces.push_back(
            {ribbon.right[i], ribbon.right[i + 1], ribbon.left[i + 1], ribbon.left[i]});
    ribbon.simple =
        !has_hairpin(line) && std::all_of(ribbon.pieces.begin(), ribbon.pieces.end(), is_proper);
    if (!ribbon.simple)
        ribbon.pieces = square_pieces(line, right, left);
    return ribbon;
}

double height_along(const Line& line, const Eigen::Vector2d& p) {
    double least = std::numeric_limits<double>::infinity();
    double height = line[0].z();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector2d start = flat(line[i]);
        const Eigen::Vector2d along = flat(line[i + 1]) - start;
        const double share = std::clamp((p - start).dot(along) / along.squaredNorm(), 0.0, 1.0);
        const double distance = (p - start - share * along).squaredNorm();
        if (distance >= least)
            continue;
        least = distance;
        height = line[i].z() + share * (line[i + 1].z() - line[i].z());
    }
    return height;
}

}  // namespace reprise::ground

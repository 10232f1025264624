// Must: give crossing paths the same height, so that one surface can carry both.
// Assumes: paths of one junction that come near each other in plan are on the same level, unless
//   they are a world::level_spacing apart.
// Goes: each path is sampled every metre; the unknowns are the samples' changes of height. Least
//   squares of: differences between samples of two paths that lie near each other (weighed by
//   nearness), curvature of the change along a path, and the change itself (little). Ends that join
//   a lane outside of the junction do not move; ends that join another path move with it.
// Keeps: plan, ends, and every path that need not change.
#include "ground/mesh/level_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/SparseCholesky>

#include "ground/mesh/junction_surface.h"
#include "ground/mesh/ribbon.h"
#include "world/frames.h"
#include "world/units.h"

namespace reprise::ground {

namespace {

constexpr double sample_spacing = 1.0;   ///< [m] of samples
constexpr double reach = 1.0;            ///< [m] in plan, within which samples should agree
constexpr double agreed = 0.01;          ///< [m] between paths: nothing to do
constexpr double least_change = 0.002;   ///< [m] smaller changes of a path are not worth its points
constexpr double agreement_weight = 30;  ///< over that of curvature, which is 1
constexpr double rest_weight = 1e-3;     ///< of the change itself: where nothing else speaks, none

constexpr int fixed = -1;  ///< a sample that does not move

struct Path {
    std::uint32_t lane = 0;
    std::vector<Eigen::Vector3d> samples;
    std::vector<int> unknowns;  ///< one for each sample, or `fixed`
};

/// Samples of two paths that lie near each other.
struct Meeting {
    int one = fixed;
    int other = fixed;
    double difference =
        0;  ///< [m] of the second's height over the junction's plane less the first's
    double weight = 0;
};

/// A sum of squares, (sum of factor * unknown - target)^2 * weight each, as its normal equations.
class LeastSquares {
  public:
    explicit LeastSquares(int unknowns) : right_(Eigen::VectorXd::Zero(unknowns)) {}

    /// Fixed unknowns are 0.
    void add(std::initializer_list<std::pair<int, double>> terms, double target, double weight) {
        for (const auto& [row, factor] : terms) {
            if (row == fixed)
                continue;
            right_[row] += weight * factor * target;
            for (const auto& [column, other] : terms)
                if (column != fixed)
                    entries_.emplace_back(row, column, weight * factor * other);
        }
    }

    Eigen::VectorXd solve() const {
        Eigen::SparseMatrix<double> normal(right_.size(), right_.size());
        normal.setFromTriplets(entries_.begin(), entries_.end());
        return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right_);
    }

  private:
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::VectorXd right_;
};

/// The paths of one junction.
class Leveller {
  public:
    Leveller(const world::TownT& town, std::uint32_t junction, const JunctionParts& parts);

    /// Do paths disagree anywhere?
    bool is_needed() const;

    void apply(world::TownT& town) const;

  private:
    void number_samples();
    void find_meetings();
    void meet(const Path& one, const Path& other);
    Eigen::VectorXd changes() const;

    std::vector<Path> paths_;
    std::vector<Meeting> meetings_;
    Eigen::Vector2d slope_;  ///< of the junction: samples beside each other may differ by it
    int unknowns_ = 0;
};

Leveller::Leveller(const world::TownT& town, std::uint32_t junction, const JunctionParts& parts)
    : slope_(height_of_junction(town, junction, parts).slope()) {
    for (const std::uint32_t lane : parts.paths)
        paths_.push_back(
            {lane, with_more_points(clean_line(town.lanes[lane].centre), sample_spacing), {}});
    number_samples();
    find_meetings();
}

/// An end moves only where one path runs on into another one.
void Leveller::number_samples() {
    struct End {
        bool starts = false;
        bool ends = false;
        int unknown = fixed;
    };

    const auto key_of = [](const Eigen::Vector3d& p) {
        constexpr double per_metre = 100;
        return std::array<long, 3>{std::lround(p.x() * per_metre),
                                   std::lround(p.y() * per_metre),
                                   std::lround(p.z() * per_metre)};
    };
    std::map<std::array<long, 3>, End> ends;
    for (const Path& path : paths_) {
        ends[key_of(path.samples.front())].starts = true;
        ends[key_of(path.samples.back())].ends = true;
    }
    for (auto& [key, end] : ends)
        if (end.starts && end.ends)
            end.unknown = unknowns_++;
    for (Path& path : paths_) {
        path.unknowns.push_back(ends[key_of(path.samples.front())].unknown);
        for (std::size_t i = 1; i + 1 < path.samples.size(); ++i)
            path.unknowns.push_back(unknowns_++);
        path.unknowns.push_back(ends[key_of(path.samples.back())].unknown);
    }
}

void Leveller::meet(const Path& one, const Path& other) {
    for (std::size_t i = 0; i < one.samples.size(); ++i)
        for (std::size_t k = 0; k < other.samples.size(); ++k) {
            const Eigen::Vector3d apart = other.samples[k] - one.samples[i];
            const double distance = apart.head<2>().norm();
            if (distance < reach && std::abs(apart.z()) < world::level_spacing)
                meetings_.push_back({one.unknowns[i],
                                     other.unknowns[k],
                                     apart.z() - slope_.dot(apart.head<2>()),
                                     1 - distance / reach});
        }
}

void Leveller::find_meetings() {
    std::vector<world::Box> boxes;
    for (const Path& path : paths_) {
        boxes.emplace_back();
        for (const Eigen::Vector3d& sample : path.samples)
            boxes.back().take(sample.head<2>(), reach / 2);
    }
    for (std::size_t one = 0; one < paths_.size(); ++one)
        for (std::size_t other = one + 1; other < paths_.size(); ++other)
            if ((boxes[one].low.array() < boxes[other].high.array()).all() &&
                (boxes[other].low.array() < boxes[one].high.array()).all())
                meet(paths_[one], paths_[other]);
}

bool Leveller::is_needed() const {
    return std::any_of(meetings_.begin(), meetings_.end(), [](const Meeting& meeting) {
        return std::abs(meeting.difference) > agreed;
    });
}

Eigen::VectorXd Leveller::changes() const {
    LeastSquares squares(unknowns_);
    for (const Meeting& meeting : meetings_)
        squares.add({{meeting.other, 1}, {meeting.one, -1}},
                    -meeting.difference,
                    agreement_weight * meeting.weight);
    for (const Path& path : paths_) {
        const std::vector<int>& at = path.unknowns;
        // Beyond its ends a path goes on unchanged, so that it leaves them without a kink.
        for (std::size_t i = 0; i < at.size(); ++i)
            squares.add({{i > 0 ? at[i - 1] : fixed, 1},
                         {at[i], -2},
                         {i + 1 < at.size() ? at[i + 1] : fixed, 1}},
                        0,
                        1);
        for (const int unknown : at)
            squares.add({{unknown, 1}}, 0, rest_weight);
    }
    return squares.solve();
}

void Leveller::apply(world::TownT& town) const {
    const Eigen::VectorXd change = changes();
    for (const Path& path : paths_) {
        world::LaneT& lane = town.lanes[path.lane];
        std::vector<world::Vec3> centre;
        double most = 0;
        double length = 0;
        for (std::size_t i = 0; i < path.samples.size(); ++i) {
            Eigen::Vector3d p = path.samples[i];
            const double by = path.unknowns[i] == fixed ? 0 : change[path.unknowns[i]];
            p.z() += by;
            most = std::max(most, std::abs(by));
            if (i > 0)
                length += (p - world::to_eigen(centre.back())).norm();
            centre.push_back(world::to_vec3(p));
        }
        if (most < least_change)
            continue;
        lane.centre = std::move(centre);
        lane.length = length;
    }
}

}  // namespace

void level_paths(world::TownT& town) {
    const std::vector<JunctionParts> parts = parts_of_junctions(town);
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const Leveller leveller(town, i, parts[i]);
        if (leveller.is_needed())
            leveller.apply(town);
    }
}

}  // namespace reprise::ground

// What it must do: join levels by ramps that a car can drive, on every road around a bridge.
// What it assumes: steps of the network are shorter where the road must be nearly level.
// How it goes: one storey after the other. What a road rises for it depends on how far it is, along
//   the roads, to the nearest point that must be up and to the nearest one that must stay down: a
//   smooth step, 112 m long where there is room. So side streets of a ramp rise with it. Two
//   bridges near each other leave a kink between their ramps: least squares of the change and of
//   the curvature then round it off. Where roads cross on one level, all points are one unknown.
// What it keeps: points with a level.
#include "towns/bridges/road_heights.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <Eigen/SparseCholesky>

namespace reprise::towns {

namespace {

constexpr double usual_slope = 0.08;                             ///< the steepest of main roads
constexpr double steepness = 1.5;                                ///< of smooth_step
constexpr double ramp = steepness * level_height / usual_slope;  ///< [m]
constexpr double rounding = 12;  ///< [m] about this far from it a kink is felt
constexpr int fixed = -1;        ///< a point that is not smoothed

/// From 0 to 1, with level ends.
double smooth_step(double share) {
    return share * share * (3 - 2 * share);
}

/// The heights for one storey: from `sign` * (storey - 1) up (or down) to `sign` * storey.
void add_storey(int storey,
                int sign,
                const RoadChains& roads,
                const Levels& levels,
                std::vector<double>& heights) {
    std::vector<Source> upper, lower;
    for (const auto& [point, level] : levels.levels)
        if (const int above = level * sign - storey; above >= 0)
            // What is higher still comes down through this storey only beyond its own ramp.
            upper.push_back({point, -above * ramp});
        else
            lower.push_back({point, 0});
    const std::vector<double> to_upper = distances(roads, upper, ramp);
    const std::vector<double> to_lower = distances(roads, lower, ramp);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const double down = std::max(to_upper[i], 0.0);
        const double up = std::min(to_lower[i], ramp - down);
        if (up > 0)
            heights[i] += sign * level_height * smooth_step(up / (up + down));
    }
}

/// Rounds off kinks of the heights.
class Smoother {
  public:
    Smoother(const RoadChains& roads, const Levels& levels, std::vector<double>& heights);

    void smooth();

  private:
    struct Term {
        std::uint32_t point = 0;
        double factor = 0;
    };

    void add(const std::vector<Term>& terms, double target, double weight);
    void add_point(std::uint32_t point);

    const RoadChains& roads_;
    std::vector<double>& heights_;
    std::vector<int> unknowns_;  ///< of each point, or `fixed`
    int count_ = 0;
    std::vector<Eigen::Triplet<double>> normal_;
    Eigen::VectorXd right_;
};

/// For each point the first one of those that must have its very height.
std::vector<std::uint32_t> first_of_equals(std::size_t points, const Levels& levels) {
    std::vector<std::uint32_t> first(points);
    std::iota(first.begin(), first.end(), 0U);
    const auto root = [&](std::uint32_t point) {
        while (first[point] != point)
            point = first[point];
        return point;
    };
    for (const std::vector<std::uint32_t>& group : levels.crossed)
        for (const std::uint32_t point : group) {
            const std::uint32_t one = root(group.front()), other = root(point);
            first[std::max(one, other)] = std::min(one, other);
        }
    for (std::uint32_t i = 0; i < points; ++i)
        first[i] = root(i);
    return first;
}

/// What is near a ramp, and has no level of its own, may move.
Smoother::Smoother(const RoadChains& roads, const Levels& levels, std::vector<double>& heights)
    : roads_(roads),
      heights_(heights),
      unknowns_(roads.places.size(), fixed) {
    constexpr double margin = 4 * rounding;
    std::vector<Source> raised;
    for (std::uint32_t i = 0; i < heights.size(); ++i)
        if (heights[i] != 0)
            raised.push_back({i, 0});
    const std::vector<double> to_raised = distances(roads, raised, margin);
    const std::vector<std::uint32_t> first = first_of_equals(heights.size(), levels);
    std::map<std::uint32_t, double> known;
    for (const auto& [point, level] : levels.levels)
        known[first[point]] = heights[point];
    for (std::uint32_t i = 0; i < heights.size(); ++i) {
        const bool follows = first[i] != i && unknowns_[first[i]] != fixed;
        const auto same = known.find(first[i]);
        if (levels.levels.contains(i))
            continue;
        if (same != known.end())
            heights[i] = same->second;
        else if (follows)
            unknowns_[i] = unknowns_[first[i]];
        else if (to_raised[i] < margin)
            unknowns_[i] = count_++;
    }
    right_ = Eigen::VectorXd::Zero(count_);
}

/// (sum of factor * height - target)^2 * weight.
void Smoother::add(const std::vector<Term>& terms, double target, double weight) {
    double rest = target;
    for (const Term& term : terms)
        if (unknowns_[term.point] == fixed)
            rest -= term.factor * heights_[term.point];
    for (const Term& row : terms) {
        if (unknowns_[row.point] == fixed)
            continue;
        right_[unknowns_[row.point]] += weight * row.factor * rest;
        for (const Term& column : terms)
            if (unknowns_[column.point] != fixed)
                normal_.emplace_back(unknowns_[row.point],
                                     unknowns_[column.point],
                                     weight * row.factor * column.factor);
    }
}

void Smoother::add_point(std::uint32_t point) {
    double span = 0;
    std::vector<Term> curvature{{point, 0}};
    for (const RoadChains::Step& step : roads_.steps[point]) {
        span += step.length / 2;
        curvature.push_back({step.to, 1 / step.length});
        curvature[0].factor -= 1 / step.length;
    }
    if (unknowns_[point] != fixed)
        add({{point, 1}}, heights_[point], std::max(span, 0.1));
    // At junctions and dead ends a road may begin with any slope: it is level there anyway.
    if (roads_.steps[point].size() == 2)
        add(curvature, 0, std::pow(rounding, 4) / span);
}

void Smoother::smooth() {
    if (count_ == 0)
        return;
    for (std::uint32_t i = 0; i < heights_.size(); ++i)
        add_point(i);
    Eigen::SparseMatrix<double> normal(count_, count_);
    normal.setFromTriplets(normal_.begin(), normal_.end());
    const Eigen::VectorXd found =
        Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right_);
    for (std::size_t i = 0; i < heights_.size(); ++i)
        if (unknowns_[i] != fixed)
            heights_[i] = found[unknowns_[i]];
}

}  // namespace

std::vector<double> find_heights(const RoadChains& roads, const Levels& levels) {
    std::vector<double> heights(roads.places.size(), 0.0);
    int highest = 0;
    int lowest = 0;
    for (const auto& [point, level] : levels.levels) {
        highest = std::max(highest, level);
        lowest = std::min(lowest, level);
    }
    for (int storey = 1; storey <= highest; ++storey)
        add_storey(storey, 1, roads, levels, heights);
    for (int storey = 1; storey <= -lowest; ++storey)
        add_storey(storey, -1, roads, levels, heights);
    Smoother(roads, levels, heights).smooth();
    return heights;
}

}  // namespace reprise::towns

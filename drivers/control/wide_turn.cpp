#include "drivers/control/wide_turn.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"
#include "world/models/car_model.h"

namespace reprise::drivers {

namespace {

constexpr int rounds = 30;                    // of Gauss-Newton
constexpr double small_step = 0.01;           // [m] near enough
constexpr double first_damping = 1;           // of Levenberg and Marquardt
constexpr double from_kerb = 0.25;            // [m] kept from kerbs
constexpr double from_obstacle = 0.15;        // [m] beyond what LateralClearances keeps
constexpr double least_clearance = 0.9;       // [m] no kerb of a good map is nearer (town check)
constexpr double steering_share = 0.9;        // of the greatest angle: the rest corrects
constexpr double lateral_acceleration = 1.5;  // [m/s^2] standing passengers, high loads
constexpr double deceleration = 1.5;          // [m/s^2] before bends

constexpr double behind = 4;                 // [m] of path kept behind the rear axle
constexpr std::size_t fewest_stations = 12;  // behind the axle, and some ahead

// What counts as much as what.
constexpr double driven_error = 0.01;      // [m]
constexpr double kerb_error = 0.05;        // [m]
constexpr double verge_error = 0.2;        // [m]
constexpr double obstacle_error = 0.02;    // [m]
constexpr double line_error = 0.3;         // [m] over the lane of those who wait at the end of it
constexpr double middle_error = 1.0;       // [m]
constexpr double steering_error = 0.03;    // [1/m^2] change of curvature along the track
constexpr double curvature_error = 0.005;  // [1/m] beyond the sharpest

Eigen::Vector2d to_left(const Eigen::Vector2d& v) {
    return {-v.y(), v.x()};
}

}  // namespace

/// A sample of the path, what is beside it, and the vehicle with its rear axle there.
struct WideTurnPlan::Station {
    Eigen::Vector3d path;
    Eigen::Vector2d left;  ///< unit, across the path
    LateralClearance clearance_left, clearance_right;
    double offset = 0;  ///< [m] of the rear axle, to the left
    Eigen::Vector2d axle;
    Eigen::Vector2d ahead;  ///< unit: the body's x axis
    double span = 1;        ///< [m] from the axle before to the axle behind
};

/// A point of the body.
struct WideTurnPlan::Corner {
    std::size_t station = 0;            ///< of the rear axle
    std::size_t beside = 0;             ///< the station that the point is nearest to
    double offset = 0;                  ///< [m] left of the path
    std::array<double, 3> change = {};  ///< of it, for a metre of offset station - 1, 0, + 1
};

WideTurnPlan::WideTurnPlan(const world::VehicleModel& model, const LateralClearances& clearances)
    : model_(&model),
      clearances_(&clearances) {}

WideTurnPlan::~WideTurnPlan() = default;

void WideTurnPlan::plan(const Path& path, const Ego& ego) {
    look_around(path, ego.rear_axle_s);
    points_.clear();
    swept_.clear();
    if (stations_.size() < fewest_stations)
        return;
    start_here(ego);
    Eigen::VectorXd offsets = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(stations_.size()));
    BandEquations equations = equations_at(offsets);
    double damping = first_damping;
    for (int round = 0; round < rounds; ++round) {
        const Eigen::VectorXd step = equations.solve(damping);
        BandEquations next = equations_at(offsets + step);
        if (next.sum() < equations.sum()) {
            offsets += step;
            equations = std::move(next);
            damping /= 4;
            if (step.cwiseAbs().maxCoeff() < small_step)
                break;
        } else {
            damping *= 8;
        }
    }
    place(offsets);
    finish();
    sweep(path);
}

/// The plan goes on from how the vehicle stands: the stations up to the one ahead of its rear axle
/// lie on the circle that it drives.
void WideTurnPlan::start_here(const Ego& ego) {
    const double curvature = std::tan(ego.steering_angle) / model_->wheelbase;
    const auto reached = static_cast<std::size_t>((ego.rear_axle_s - start_) / Path::spacing);
    driven_.clear();
    for (std::size_t i = 0; i <= std::min(reached + 1, stations_.size() - 1); ++i) {
        const double ahead = start_ + static_cast<double>(i) * Path::spacing - ego.rear_axle_s;
        const Eigen::Vector2d there = ego.position.head<2>() + ahead * ego.direction +
                                      curvature * ahead * ahead / 2 * to_left(ego.direction);
        driven_.push_back((there - stations_[i].path.head<2>()).dot(stations_[i].left));
    }
}

/// The vehicle with its rear axle at these offsets, [m] left of the path, and what is wrong then.
BandEquations WideTurnPlan::equations_at(const Eigen::VectorXd& offsets) {
    place(offsets);
    BandEquations equations(stations_.size());
    for (std::size_t i = 0; i < driven_.size(); ++i)
        equations.add<1>(i, {1.0}, stations_[i].offset - driven_[i], driven_error);
    add_track(equations);
    add_footprint(equations);
    return equations;
}

/// Takes the samples over from just behind the rear axle on, with what is known of those that have
/// not changed.
void WideTurnPlan::look_around(const Path& path, double rear_axle_s) {
    const std::vector<Station> known = std::move(stations_);
    const double known_start = start_;
    const std::size_t first = path.index(rear_axle_s - behind);
    start_ = path.s_of(first);
    stations_.clear();
    const auto shift = std::llround((start_ - known_start) / Path::spacing);
    for (const PathPoint& point : path.points().subspan(first)) {
        const auto before = static_cast<std::size_t>(
            std::max<long long>(static_cast<long long>(stations_.size()) + shift, -1));
        Station station;
        station.path = point.position;
        station.left = to_left(point.direction);
        if (before < known.size() && known[before].path == station.path &&
            known[before].left == station.left) {
            station.clearance_left = known[before].clearance_left;
            station.clearance_right = known[before].clearance_right;
        } else {
            station.clearance_left = clearances_->look(station.path, station.left);
            station.clearance_right = clearances_->look(station.path, -station.left);
            const Eigen::Vector2d ahead = -to_left(station.left);
            station.clearance_left.to_waiting =
                clearances_->look_for_line(station.path, station.left, ahead);
            station.clearance_right.to_waiting =
                clearances_->look_for_line(station.path, -station.left, ahead);
        }
        stations_.push_back(station);
    }
}

/// Puts the vehicle where the offsets say.
void WideTurnPlan::place(const Eigen::VectorXd& offsets) {
    for (std::size_t i = 0; i < stations_.size(); ++i) {
        Station& station = stations_[i];
        station.offset = offsets[static_cast<Eigen::Index>(i)];
        station.axle = station.path.head<2>() + station.offset * station.left;
    }
    const std::size_t last = stations_.size() - 1;
    for (std::size_t i = 0; i <= last; ++i) {
        const Eigen::Vector2d span =
            stations_[std::min(i + 1, last)].axle - stations_[i - std::min<std::size_t>(i, 1)].axle;
        stations_[i].span = std::max(span.norm(), 1e-3);
        stations_[i].ahead = span / stations_[i].span;
    }
}

/// The track's bends, and the middle of the vehicle on the path.
void WideTurnPlan::add_track(BandEquations& equations) const {
    const double sharpest =
        std::tan(steering_share * model_->max_steering_angle) / model_->wheelbase;
    double curvature_before = 0;
    std::array<double, 3> change_before{};
    for (std::size_t i = 1; i + 1 < stations_.size(); ++i) {
        const Station& station = stations_[i];
        const Eigen::Vector2d left = to_left(station.ahead);
        const double square = station.span * station.span / 4;
        const Station& last = stations_[i - 1];
        const Station& next = stations_[i + 1];
        const double curvature = (next.axle - 2 * station.axle + last.axle).dot(left) / square;
        const std::array<double, 3> change{last.left.dot(left) / square,
                                           -2 * station.left.dot(left) / square,
                                           next.left.dot(left) / square};
        if (i > 1) {
            const double h = Path::spacing;
            equations.add<4>(i - 2,
                             {-change_before[0] / h,
                              (change[0] - change_before[1]) / h,
                              (change[1] - change_before[2]) / h,
                              change[2] / h},
                             (curvature - curvature_before) / h,
                             steering_error);
        }
        if (std::abs(curvature) > sharpest)
            equations.add<3>(
                i - 1, change, curvature - std::copysign(sharpest, curvature), curvature_error);
        curvature_before = curvature;
        change_before = change;
    }
}

void WideTurnPlan::add_footprint(BandEquations& equations) const {
    for (std::size_t i = std::max<std::size_t>(driven_.size(), 1); i + 1 < stations_.size(); ++i)
        add_middle(equations, i);
    for_each_corner([&](const Corner& corner) { add_corner(equations, corner); });
}

/// Both sides of the body at each sample, as far as the path reaches.
template <typename Visit>
void WideTurnPlan::for_each_corner(Visit&& visit) const {
    const double front = model_->length - model_->rear_overhang;
    const double base = model_->wheelbase;
    const double side = model_->width / 2;
    for (std::size_t i = std::max<std::size_t>(driven_.size(), 1); i + 1 < stations_.size(); ++i)
        for (const double ahead :
             {-model_->rear_overhang, 0.0, base / 4, base / 2, 3 * base / 4, base, front})
            for (const double left : {side, -side}) {
                const Corner found = corner(i, ahead, left);
                if (found.beside > 0 && found.beside + 1 < stations_.size())
                    visit(found);
            }
}

WideTurnPlan::Corner WideTurnPlan::corner(std::size_t station, double ahead, double left) const {
    const Station& here = stations_[station];
    const Eigen::Vector2d across = to_left(here.ahead);
    const Eigen::Vector2d position = here.axle + ahead * here.ahead + left * across;
    Corner corner;
    corner.beside = nearest(position, station);
    const Station& there = stations_[corner.beside];
    corner.station = station;
    corner.offset = (position - there.path.head<2>()).dot(there.left);
    // Turning the body moves its points.
    const double turn = (ahead * across - left * here.ahead).dot(there.left) / here.span;
    corner.change = {-turn * across.dot(stations_[station - 1].left),
                     here.left.dot(there.left),
                     turn * across.dot(stations_[station + 1].left)};
    return corner;
}

void WideTurnPlan::add_middle(BandEquations& equations, std::size_t station) const {
    const Corner middle = corner(station, model_->wheelbase / 2, 0);
    if (middle.beside + 1 < stations_.size())
        equations.add(station - 1, middle.change, middle.offset, middle_error);
}

void WideTurnPlan::add_corner(BandEquations& equations, const Corner& corner) const {
    const Station& there = stations_[corner.beside];
    for (const double sign : {1.0, -1.0}) {
        const LateralClearance& clearance = sign > 0 ? there.clearance_left : there.clearance_right;
        const double offset = sign * corner.offset;
        const double over_kerb = offset - std::max(clearance.to_kerb - from_kerb, least_clearance);
        if (over_kerb > 0)
            equations.add(corner.station - 1, corner.change, sign * over_kerb, kerb_error);
        const double over_verge = offset - std::max(clearance.to_verge, least_clearance);
        if (over_verge > 0)
            equations.add(corner.station - 1, corner.change, sign * over_verge, verge_error);
        const double over_line = offset - std::max(clearance.to_waiting, least_clearance);
        if (over_line > 0)
            equations.add(corner.station - 1, corner.change, sign * over_line, line_error);
        const double over_obstacle =
            offset - std::max(clearance.to_obstacle - from_obstacle, least_clearance);
        if (over_obstacle > 0)
            equations.add(corner.station - 1, corner.change, sign * over_obstacle, obstacle_error);
    }
}

/// The sample nearest to p, downhill from a guess.
std::size_t WideTurnPlan::nearest(const Eigen::Vector2d& p, std::size_t guess) const {
    const auto distance = [&](std::size_t i) {
        return (stations_[i].path.head<2>() - p).squaredNorm();
    };
    std::size_t best = guess;
    while (best + 1 < stations_.size() && distance(best + 1) < distance(best))
        ++best;
    while (best > 0 && distance(best - 1) < distance(best))
        --best;
    return best;
}

/// Headings, curvatures, and the speeds that they allow.
void WideTurnPlan::finish() {
    const std::size_t count = stations_.size();
    points_.assign(count, {});
    for (std::size_t i = 0; i < count; ++i) {
        const Station& station = stations_[i];
        points_[i].position = station.axle;
        const double yaw = std::atan2(station.ahead.y(), station.ahead.x());
        points_[i].yaw =
            i == 0 ? yaw : points_[i - 1].yaw + world::wrap_angle(yaw - points_[i - 1].yaw);
    }
    for (std::size_t i = 1; i + 1 < count; ++i)
        points_[i].curvature = (points_[i + 1].yaw - points_[i - 1].yaw) / stations_[i].span;
    points_.front().curvature = points_[1].curvature;
    points_.back().curvature = points_[count - 2].curvature;
    double next = INFINITY;
    for (std::size_t i = count; i-- > 0;) {
        const double curvature = std::abs(points_[i].curvature);
        const double angle = std::atan(model_->wheelbase * curvature);
        const double before = std::atan(
            model_->wheelbase * std::abs(points_[i - std::min<std::size_t>(i, 1)].curvature));
        const double turning = std::abs(angle - before) / Path::spacing;
        const double wheels = 0.6 * world::steering_rate / std::max(turning, 1e-6);
        next = std::min({lateral_acceleration / std::max(curvature, 1e-6),
                         wheels * wheels,
                         next + 2 * deceleration * Path::spacing});
        points_[i].squared_speed = next;
    }
}

void WideTurnPlan::sweep(const Path& path) {
    swept_.assign(path.points().size(), {model_->width / 2, model_->width / 2});
    const std::size_t first = swept_.size() - stations_.size();
    for_each_corner([&](const Corner& corner) {
        // In a bend the outer corners pass two samples at a time.
        for (std::size_t i = corner.beside - 1; i <= corner.beside + 1; ++i) {
            SweptWidth& width = swept_[first + i];
            width.left = std::max(width.left, corner.offset);
            width.right = std::max(width.right, -corner.offset);
        }
    });
}

void WideTurnPlan::add_to(world::Hasher& hasher) const {
    hasher.add(start_);
    for (const WideTurnPoint& point : points_)
        for (const double number : {point.position.x(), point.position.y(), point.squared_speed})
            hasher.add(number);
}

WideTurnPoint WideTurnPlan::at(double s) const {
    const double steps = std::max((s - start_) / Path::spacing, 0.0);
    const auto i = static_cast<std::size_t>(steps);
    if (i + 1 >= points_.size())
        return points_.back();
    const double share = steps - static_cast<double>(i);
    const WideTurnPoint& source = points_[i];
    const WideTurnPoint& target = points_[i + 1];
    const auto mix = [share](double a, double b) { return a + (b - a) * share; };
    return {source.position + (target.position - source.position) * share,
            mix(source.yaw, target.yaw),
            mix(source.curvature, target.curvature),
            mix(source.squared_speed, target.squared_speed)};
}

}  // namespace reprise::drivers

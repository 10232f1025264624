#include "ground/swept_area.h"

#include <algorithm>
#include <cmath>

#include "world/models/catalogue.h"
#include "world/town.h"

namespace reprise::ground {

namespace {

using Eigen::Vector2d;

constexpr double pace = 0.25;        ///< [m] of the bumper
constexpr int steps_a_body = 3;      ///< what moves by less is covered by the body before
constexpr double most_aside = 0.45;  ///< [m] aside for each metre driven, of the axle: CarReader's
constexpr double slight = 0.06;      ///< sine of an angle at which its tail stays in its lane
constexpr double axle_behind = 12;   ///< [m] until its axle is out of the bend as well

/// A line, and places on it by metres.
class Way {
  public:
    void add(const world::LaneT& lane) {
        for (const world::Vec3& point : lane.centre) {
            const Vector2d p = world::in_plan(point);
            const double step = points_.empty() ? 0 : (p - points_.back()).norm();
            if (!points_.empty() && step < 1e-3)
                continue;
            ends_.push_back(points_.empty() ? 0 : ends_.back() + step);
            points_.push_back(p);
            heights_.push_back(point.z());
        }
    }

    bool is_line() const { return points_.size() > 1; }

    double length() const { return ends_.back(); }

    /// Beyond its ends straight on.
    Vector2d at(double s) const {
        const std::size_t i = piece(s);
        return points_[i - 1] + (s - ends_[i - 1]) * ahead(i);
    }

    Vector2d ahead_at(double s) const { return ahead(piece(s)); }

    double height_at(double s) const {
        const std::size_t i = piece(s);
        return heights_[i - 1] +
               (s - ends_[i - 1]) * (heights_[i] - heights_[i - 1]) / (ends_[i] - ends_[i - 1]);
    }

  private:
    std::size_t piece(double s) const {
        return static_cast<std::size_t>(std::upper_bound(ends_.begin() + 1, ends_.end() - 1, s) -
                                        ends_.begin());
    }

    Vector2d ahead(std::size_t i) const {
        return (points_[i] - points_[i - 1]) / (ends_[i] - ends_[i - 1]);
    }

    std::vector<Vector2d> points_;
    std::vector<double> heights_;  ///< [m] of them
    std::vector<double> ends_;     ///< [i] metres to points_[i]
};

/// The way, on over a link to the end of the lane there.
Way way_over(const world::TownT& town, Way way, const world::Link& link) {
    constexpr int most_pieces = 8;  // of a way over a junction
    std::uint32_t next = link.via();
    for (int i = 0; i < most_pieces && next != world::none; ++i) {
        way.add(town.lanes[next]);
        next = town.lanes[next].links.empty() ? world::none : town.lanes[next].links[0].via();
    }
    way.add(town.lanes[link.to()]);
    return way;
}

/// Of a bus whose bumper drives from one place of the way to another.
void add_bodies(const Way& way, double from, double to, std::vector<SweptBody>& bodies) {
    const world::VehicleModel& bus =
        world::vehicle_models()[world::find_vehicle_model("bus").value()];
    const double to_axle = bus.length - bus.rear_overhang;
    Vector2d rear = way.at(from - to_axle);
    Vector2d ahead = (way.at(from) - rear).normalized();
    int step = 0;
    for (double front = from; front < to; front += pace, ++step) {
        // On the tightest bends the axle follows only as far as wheels roll.
        const Vector2d wanted = way.at(front - to_axle);
        const double aside = world::cross(ahead, wanted - rear);
        const double rolled = std::clamp(aside, -most_aside * pace, most_aside * pace);
        rear = wanted - world::turned_left(ahead) * (aside - rolled);
        ahead = (way.at(front) - rear).normalized();
        const double crooked =
            std::max(std::abs(world::cross(ahead, way.ahead_at(front))),
                     std::abs(world::cross(ahead, way.ahead_at(front - to_axle))));
        if (step % steps_a_body == 0 && crooked > slight)
            bodies.push_back({rear + ahead * (bus.length / 2 - bus.rear_overhang),
                              std::atan2(ahead.y(), ahead.x()),
                              bus.length,
                              bus.width,
                              way.height_at(front)});
    }
}

/// On from the end of a way, which ends with that lane, until its axle is through the first
/// junction: over more than one where the lanes between them are short. `end` [m] along the way; 0:
/// that junction is the next one.
void drive_on(const world::TownT& town,
              const world::LaneT& lane,
              const Way& way,
              double end,
              int junctions,
              std::vector<SweptBody>& bodies) {
    for (const world::Link& link : lane.links) {
        if (link.turn() == world::Turn::around && lane.links.size() > 1)
            continue;  // nobody turns a bus around where it can go on
        const world::LaneT& behind = town.lanes[link.to()];
        const Way next = way_over(town, way, link);
        Way last;
        last.add(behind);
        const double until = end > 0 ? end : next.length() - last.length() + axle_behind;
        add_bodies(next, way.length(), std::min(next.length(), until), bodies);
        if (next.length() < until && junctions > 1)
            drive_on(town, behind, next, until, junctions - 1, bodies);
    }
}

}  // namespace

world::Loop SweptBody::corners(double smaller) const {
    const Vector2d along = world::ahead_of(yaw) * (length / 2 - smaller);
    const Vector2d across = world::left_of(yaw) * (width / 2 - smaller);
    return {centre - along - across,
            centre + along - across,
            centre + along + across,
            centre - along + across};
}

std::vector<SweptBody> bus_bodies(const world::TownT& town) {
    constexpr int most_junctions = 4;  // until its axle is through the first one
    std::vector<SweptBody> bodies;
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::driving)
            continue;
        Way way;
        way.add(lane);
        if (!way.is_line())
            continue;
        add_bodies(way, 0, way.length(), bodies);
        drive_on(town, lane, way, 0, most_junctions, bodies);
    }
    return bodies;
}

}  // namespace reprise::ground

#include "traffic/insertion_points.h"

#include <algorithm>
#include <cmath>

#include "traffic/cars/fleet.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

namespace {

constexpr double free_at_start = 1;  // [m] kept free at the start of a lane
constexpr double free_at_end = 4;    // [m] and before its end
constexpr double person = 0.6;       // [m] through somebody on his feet
constexpr double least_margin = 3;   // [m] between cars that stand in line
constexpr double to_change = 80;     // [m] before a lane ends beside one that leads on

Eigen::Vector2d direction(double yaw) {
    return {std::cos(yaw), std::sin(yaw)};
}

/// [m] behind the end of a lane until its road goes on for this car and it does not: it is a
/// parking lane, or one that ends, and who is at its end waits there for a gap beside him. At most
/// `far`.
double way_of_its_own(std::uint32_t lane,
                      world::ClassSet car,
                      double far,
                      const world::TownT& town,
                      const RoadGraph& graph) {
    if (far <= 0)
        return 0;
    const auto is_way = [&](const world::Link& link) {
        return graph.edge_of(link.to()) != world::none && graph.may_use(link.to(), car);
    };
    const auto leads_on = [&](std::uint32_t one) {
        return std::ranges::any_of(town.lanes[one].links, is_way);
    };
    if (!leads_on(lane))
        return std::ranges::any_of(graph.edge(graph.edge_of(lane)).lanes, leads_on) ? 0 : far;
    double longest = 0;
    for (const world::Link& link : town.lanes[lane].links) {
        if (longest >= far || !is_way(link))
            continue;
        const double length = std::min(town.lanes[link.to()].length, far);
        longest =
            std::max(longest, length + way_of_its_own(link.to(), car, far - length, town, graph));
    }
    return longest;
}

}  // namespace

OccupiedBox box_of(const Car& car) {
    return {(car.rear + car.trail.front()).head<2>() / 2,
            car.yaw,
            world::vehicle_models()[car.model].length,
            false};
}

InsertionPoints::InsertionPoints(const world::TownT& town, const RoadGraph& graph)
    : town_(&town),
      graph_(&graph) {
    double sum = 0;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (town.lanes[i].kind != world::LaneKind::driving)
            continue;
        sum += town.lanes[i].length;
        lanes_.push_back(i);
        ends_.push_back(sum);
    }
}

/// The point that this number in [0, 1) falls on. None where the car does not fit between the ends
/// of the lane or may not drive.
std::optional<InsertionPoint> InsertionPoints::at(double drawn,
                                                  double car_length,
                                                  world::ClassSet car) const {
    const double metre = drawn * ends_.back();
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), metre);
    const auto index = std::min(static_cast<std::size_t>(found - ends_.begin()), lanes_.size() - 1);
    const std::uint32_t lane = lanes_[index];
    const double length = town_->lanes[lane].length;
    const double s = metre - (ends_[index] - length);
    if (s < car_length + free_at_start || s > length - free_at_end || !graph_->may_use(lane, car))
        return std::nullopt;
    if (length - s < to_change &&
        length - s + way_of_its_own(lane, car, to_change, *town_, *graph_) < to_change)
        return std::nullopt;
    return InsertionPoint{lane, s};
}

std::optional<InsertionPoint> InsertionPoints::find(std::span<const OccupiedBox> occupied,
                                                    InsertionSearch& search) const {
    for (int i = 0; i < search.tries; ++i) {
        const double drawn = world::draw(search.seed, search.tick, search.purpose, search.item++);
        const auto point = at(drawn, search.car_length, search.car);
        // The first half of the tries asks for all the room that was wished, the rest for less.
        const double ease = std::min(1.0, 2.0 - 2.0 * i / search.tries);
        const double margin = std::max(least_margin, search.margin * ease);
        if (point && is_free(*point, search.car_length, occupied, margin, search.sight * ease))
            return point;
    }
    return search.everywhere ? scan(occupied, search) : std::nullopt;
}

std::optional<InsertionPoint> InsertionPoints::scan(std::span<const OccupiedBox> occupied,
                                                    InsertionSearch& search) const {
    constexpr double spacing = 0.5;  // [m]
    for (double looked = 0; looked < ends_.back(); looked += spacing) {
        const double drawn = search.scanned / ends_.back();
        search.scanned += spacing;
        if (search.scanned >= ends_.back())
            search.scanned = 0;
        const auto point = at(drawn, search.car_length, search.car);
        if (point && is_free(*point, search.car_length, occupied, least_margin, search.sight))
            return point;
    }
    return std::nullopt;
}

world::ClassSet InsertionPoints::common_classes() const {
    world::ClassSet common = 0;
    const double total = ends_.empty() ? 0 : ends_.back();
    for (const std::string_view name : world::vehicle_class_names()) {
        double open = 0;
        for (const std::uint32_t lane : lanes_)
            if (graph_->may_use(lane, world::class_bit(name)))
                open += town_->lanes[lane].length;
        if (open >= total / 2)
            common |= world::class_bit(name);
    }
    return common;
}

/// The box of a car with its front there.
OccupiedBox InsertionPoints::box_at(const InsertionPoint& point, double car_length) const {
    const world::LanePoint at = world::point_at(town_->lanes[point.lane], point.s - car_length / 2);
    return {at.position.head<2>(), at.yaw, car_length, false};
}

bool InsertionPoints::is_free(const InsertionPoint& point,
                              double car_length,
                              std::span<const OccupiedBox> occupied,
                              double margin,
                              double sight) const {
    constexpr double beside = 2.6;  // [m] between the middle lines of cars that pass each other
    const OccupiedBox ground = box_at(point, car_length);
    const Eigen::Vector2d along = direction(ground.yaw);
    return std::none_of(occupied.begin(), occupied.end(), [&](const OccupiedBox& other) {
        const Eigen::Vector2d apart = other.centre - ground.centre;
        if (other.is_observer && apart.norm() < sight)
            return true;
        const double dx = std::abs(apart.dot(along));
        const double dy = std::abs(apart.x() * along.y() - apart.y() * along.x());
        // A car across the way reaches out to the side.
        const double across =
            std::abs(direction(other.yaw).dot(Eigen::Vector2d(-along.y(), along.x())));
        return dy < beside + across * other.length / 2 &&
               dx < (car_length + other.length) / 2 + margin;
    });
}

std::optional<OccupiedBox> InsertionPoints::coming(const world::CommandT& command) const {
    using world::Driver;
    constexpr double reaction = 20;  // [m] drivers need time to look around, its own and others
    if (command.kind != world::CommandKind::spawn)
        return std::nullopt;
    const bool has_wheels = command.driver != Driver::walker && command.driver != Driver::prop;
    double length = person;
    if (command.driver == Driver::prop)
        length = world::prop_models()[command.model].length;
    if (has_wheels)
        length = world::vehicle_models()[command.model].length;
    // Of who stands on his feet, and of things, the place is that of their middle.
    const double to_front = has_wheels ? origin_to_front(command.model) : length / 2;
    if (command.has_pose) {
        const Eigen::Vector2d origin(command.target.x(), command.target.y());
        return OccupiedBox{origin + (to_front - length / 2) * direction(command.heading),
                           command.heading,
                           length + reaction,
                           false};
    }
    if (command.lane >= town_->lanes.size())
        return std::nullopt;
    OccupiedBox box = box_at({command.lane, command.s + to_front}, length);
    if (!has_wheels)
        box.centre += command.offset * world::turned_left(direction(box.yaw));
    box.length += reaction;
    return box;
}

std::vector<OccupiedBox> InsertionPoints::occupied(std::span<const Car> cars,
                                                   const world::TickView& last,
                                                   const world::TickDraft& next) const {
    const auto models = world::vehicle_models();
    std::vector<OccupiedBox> boxes;
    for (const Car& car : cars)
        boxes.push_back(box_of(car));
    for (const world::VehicleState& vehicle : last.vehicles())
        boxes.push_back({{vehicle.position().x(), vehicle.position().y()},
                         2 * std::atan2(vehicle.orientation().z(), vehicle.orientation().w()),
                         models[vehicle.model()].length,
                         true});
    // Nobody appears on top of people and things.
    for (const world::WalkerState& walker : last.walkers())
        boxes.push_back({{walker.position().x(), walker.position().y()},
                         static_cast<double>(walker.yaw()),
                         walker.down() ? 2.0 : person,
                         false});
    for (const world::PropState& prop : last.props())
        boxes.push_back({{prop.position().x(), prop.position().y()},
                         0,
                         world::prop_models()[prop.model()].length,
                         false});
    for (const world::CommandT& command : next.tick.commands)
        if (const auto box = coming(command))
            boxes.push_back(*box);
    return boxes;
}

}  // namespace reprise::traffic

#include "traffic/mirrors.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/sumo.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

constexpr double reach = 4;        // [m] from a centre line: further out is off the road
constexpr double way_ahead = 250;  // [m] that SUMO's cars may look at
constexpr int on_its_route = 1;    // moveToXY's keepRoute
constexpr int anywhere = 2;

double yaw_of(const world::VehicleState& vehicle) {
    const Eigen::Vector3d ahead = world::to_eigen(vehicle.orientation()) * Eigen::Vector3d::UnitX();
    return std::atan2(ahead.y(), ahead.x());
}

/// Does a body touch a lane that its front is `aside` metres left of, `turned` [rad] to the left of
/// its direction?
bool touches(std::uint16_t number, double turned, double aside, const world::LaneT& lane) {
    const world::VehicleModel& model = world::vehicle_models()[number];
    const double half = model.width / 2 * std::abs(std::cos(turned)) + lane.width / 2 - 0.1;
    const double rear = aside - model.length * std::sin(turned);
    return std::min(aside, rear) < half && std::max(aside, rear) > -half;
}

/// How well a turn fits the indicators; higher is better.
int fit(world::Turn turn, std::uint16_t lamps) {
    const bool to_left = turn == world::Turn::left || turn == world::Turn::partially_left;
    const bool to_right = turn == world::Turn::right || turn == world::Turn::partially_right;
    if (turn == world::Turn::around)
        return 0;
    if ((lamps & world::lamp_left) != 0)
        return to_left ? 3 : 1;
    if ((lamps & world::lamp_right) != 0)
        return to_right ? 3 : 1;
    return turn == world::Turn::straight ? 2 : 1;
}

}  // namespace

Mirrors::Mirrors(const world::TownT& town,
                 const world::LaneMap& lanes,
                 const RoadGraph& graph,
                 double step)
    : town_(&town),
      lanes_(&lanes),
      graph_(&graph),
      step_(step),
      short_predecessors_(lanes_with_short_predecessors(town, graph)) {}

void Mirrors::forget(const std::string& sumo) {
    std::erase_if(mirrors_, [&sumo](const Mirror& mirror) { return mirror.sumo == sumo; });
}

std::span<const std::uint32_t> Mirrors::way_of(std::uint32_t id) const {
    const auto at = std::lower_bound(
        mirrors_.begin(), mirrors_.end(), id, [](const Mirror& m, std::uint32_t wanted) {
            return m.id < wanted;
        });
    if (at == mirrors_.end() || at->id != id)
        return {};
    return at->route;
}

Mirrors::Target Mirrors::target_of(const world::VehicleState& vehicle) const {
    // The step ends one tick after the last one: there the vehicle will be, up to a centimetre.
    const double yaw = yaw_of(vehicle) + vehicle.angular_velocity().z() * step_;
    const Eigen::Vector3d origin =
        world::to_eigen(vehicle.position()) + world::to_eigen(vehicle.velocity()) * step_;
    const double ahead = origin_to_front(vehicle.model());
    const Eigen::Vector3d front = origin + ahead * Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0);
    Target target{front.x(), front.y(), sumo_angle_deg(yaw)};
    const auto found = lanes_->best(front, yaw, reach);
    // Of the ways through a junction SUMO has only those that are for cars.
    if (!found || graph_->edge_of(found->lane) == world::none)
        return target;
    const world::LaneT& lane = town_->lanes[found->lane];
    const bool inside = lane.kind == world::LaneKind::internal;
    const double turned = yaw - world::point_at(lane, found->at.s).yaw;
    // Beside the road nobody waits behind it.
    if (!inside && !touches(vehicle.model(), turned, found->at.t, lane))
        return target;
    target.lane = found->lane;
    // At the lane's end rounding must not lead beyond it: SUMO aborts.
    target.lane_position = std::min(found->at.s / lane.length, 1.0) * lane.sumo_length;
    // Bound to its route it stays there; in a junction it does while it touches the lane.
    target.on_lane = !inside || touches(vehicle.model(), 0, found->at.t, lane);
    return target;
}

std::vector<std::uint32_t> Mirrors::likely_way(std::uint32_t lane, std::uint16_t lamps) const {
    std::vector<std::uint32_t> way{graph_->edge_of(lane)};
    double length = 0;
    if (graph_->edge_after(lane) != way.front()) {
        way.push_back(graph_->edge_after(lane));
        lane = graph_->edge(way.back()).lanes.front();
    }
    while (length < way_ahead) {
        const world::Link* best = nullptr;
        for (const world::Link& link : town_->lanes[lane].links)
            if (graph_->edge_of(link.to()) != world::none &&
                (best == nullptr || fit(link.turn(), lamps) > fit(best->turn(), lamps)))
                best = &link;
        if (best == nullptr)
            break;
        lane = best->to();
        lamps = 0;  // indicators are about the next junction
        way.push_back(graph_->edge_of(lane));
        length += graph_->edge(way.back()).length;
    }
    return way;
}

Mirrors::Mirror& Mirrors::find_or_add(const world::VehicleState& vehicle,
                                      const std::string& sumo,
                                      const Target& target) {
    auto at = std::lower_bound(
        mirrors_.begin(), mirrors_.end(), vehicle.id(), [](const Mirror& m, std::uint32_t id) {
            return m.id < id;
        });
    if (at != mirrors_.end() && at->id == vehicle.id())
        return *at;
    using libsumo::Vehicle;
    Mirror mirror;
    mirror.id = vehicle.id();
    mirror.sumo = sumo;
    // Off the road it starts on some edge, and is taken away from there at once.
    const std::uint32_t start =
        target.lane == world::none ? graph_->edge(0).lanes.front() : target.lane;
    std::vector<std::uint32_t> way{graph_->edge_of(start)};
    if (graph_->edge_after(start) != way.front())
        way.push_back(graph_->edge_after(start));
    const std::string route = fmt::format("mirror {} {}", vehicle.id(), added_++);
    libsumo::Route::add(route, graph_->names(way));
    Vehicle::add(mirror.sumo, route, scripted_type(vehicle.model()), "now");
    Vehicle::moveTo(mirror.sumo, town_->lanes[start].name, target.lane_position);
    // SUMO never drives it.
    Vehicle::setSpeedMode(mirror.sumo, 0);
    Vehicle::setLaneChangeMode(mirror.sumo, 0);
    return *mirrors_.insert(at, std::move(mirror));
}

/// SUMO chooses the lane by the place, and may have gone on to the second edge of the way, or have
/// chosen another one than we named: at a dead end, where a car that turns around goes to and fro
/// between lanes. A way that starts on another edge SUMO would put behind what the vehicle has
/// passed: the route grows in every tick, leads where nothing leads, and SUMO aborts (an assertion
/// of MSVehicle::updateBestLanes). So the way is made to start where SUMO has the vehicle; false:
/// it does not lead there.
bool Mirrors::start_where_sumo_has_it(const Mirror& mirror, std::vector<std::uint32_t>& way) const {
    const std::string road = libsumo::Vehicle::getRoadID(mirror.sumo);
    if (road.empty() || road.front() == ':' || road == graph_->edge(way.front()).name)
        return true;
    if (way.size() < 2 || road != graph_->edge(way[1]).name)
        return false;
    way.erase(way.begin());
    return true;
}

/// What has been driven stays before a new way in SUMO's route. A vehicle that comes round again is
/// then on an edge that its route has twice; inside the junction behind it SUMO takes the first of
/// the two, which goes on to another road, and aborts (an assertion of MSVehicle::updateBestLanes).
/// A named route is taken as it is.
void Mirrors::set_route(const Mirror& mirror, const std::vector<std::uint32_t>& way) {
    using libsumo::Vehicle;
    const std::vector<std::string> names = graph_->names(way);
    const std::vector<std::string> route = Vehicle::getRoute(mirror.sumo);
    const auto driven = std::min(
        static_cast<std::size_t>(std::max(Vehicle::getRouteIndex(mirror.sumo), 0)), route.size());
    const bool comes_round = std::any_of(names.begin(), names.end(), [&](const std::string& edge) {
        return std::find(route.begin(),
                         route.begin() + static_cast<std::ptrdiff_t>(driven),
                         edge) != route.begin() + static_cast<std::ptrdiff_t>(driven);
    });
    if (!comes_round)
        return Vehicle::setRoute(mirror.sumo, names);
    const std::string name = fmt::format("mirror {} {}", mirror.id, added_++);
    libsumo::Route::add(name, names);
    Vehicle::setRouteID(mirror.sumo, name);
}

std::uint32_t Mirrors::lane_named(const std::string& name) const {
    const auto at = std::find_if(town_->lanes.begin(),
                                 town_->lanes.end(),
                                 [&](const world::LaneT& one) { return one.name == name; });
    return at == town_->lanes.end() ? world::none
                                    : static_cast<std::uint32_t>(at - town_->lanes.begin());
}

/// Bound to its route, SUMO takes the nearest lane of all of that: where a dead end's way back
/// begins beside the way there, one in a junction that the vehicle is not at, while its place in
/// the route stays behind. In the next step SUMO would abort (an assertion of
/// MSVehicle::adaptBestLanesOccupation). So it is put back to the road that it is on.
void Mirrors::bring_back(const Mirror& mirror, const Target& target) const {
    using libsumo::Vehicle;
    const std::string lane = Vehicle::getLaneID(mirror.sumo);
    if (mirror.edge == world::none || lane.empty() || lane.front() != ':')
        return;
    const std::uint32_t number = lane_named(lane);
    if (number == world::none || graph_->edge_of(number) == mirror.edge)
        return;
    const RoadGraph::Edge& road = graph_->edge(mirror.edge);
    const std::vector<std::string> route = Vehicle::getRoute(mirror.sumo);
    const int from = std::max(Vehicle::getRouteIndex(mirror.sumo), 0);
    if (std::find(route.begin() + from, route.end(), road.name) == route.end())
        return;
    const bool stays = target.lane != world::none && graph_->edge_of(target.lane) == mirror.edge &&
                       town_->lanes[target.lane].kind != world::LaneKind::internal;
    Vehicle::moveTo(mirror.sumo,
                    town_->lanes[stays ? target.lane : road.lanes.front()].name,
                    stays ? target.lane_position : 0);
}

void Mirrors::move(Mirror& mirror, const world::VehicleState& vehicle, const Target& target) {
    using libsumo::Vehicle;
    auto place = [&](const std::string& edge, int index, int keep_route) {
        Vehicle::moveToXY(
            mirror.sumo, edge, index, target.x, target.y, target.angle_deg, keep_route, reach + 2);
    };
    bring_back(mirror, target);
    if (target.lane == world::none) {
        place("", -1, anywhere);
        mirror.edge = mirror.after = world::none;
        mirror.route.clear();
        return;
    }
    const world::LaneT& lane = town_->lanes[target.lane];
    // SUMO makes the lane's name of it: not the index that it counts itself.
    const int index = lane.index;
    const std::uint32_t edge = graph_->edge_of(target.lane);
    const std::uint32_t after = graph_->edge_after(target.lane);
    auto at = std::find(mirror.route.begin(), mirror.route.end(), edge);
    const bool as_planned = mirror.edge != world::none && at != mirror.route.end() &&
                            (after == edge || (at + 1 != mirror.route.end() && *(at + 1) == after));
    if (!as_planned || (edge == mirror.edge && mirror.lamps != vehicle.lamps())) {
        mirror.route = likely_way(target.lane, vehicle.lamps());
        std::vector<std::uint32_t> way = mirror.route;
        const bool goes_on = mirror.edge != world::none && mirror.edge != edge;
        if (goes_on)  // SUMO still has it on the edge before
            way.insert(way.begin(), mirror.edge);
        const auto& successors =
            graph_->edge(mirror.edge == world::none ? edge : mirror.edge).successors;
        const bool connected =
            mirror.edge != world::none &&
            (!goes_on || std::binary_search(successors.begin(), successors.end(), edge));
        if (!connected || !start_where_sumo_has_it(mirror, way)) {
            // SUMO finds the edge by the place, and takes it for the whole route until the next
            // tick.
            place(lane.edge, index, anywhere);
            mirror.route = {edge};
            mirror.edge = edge;
            mirror.after = after;
            mirror.lamps = 0xffff;
            return;
        }
        set_route(mirror, way);
        mirror.lamps = vehicle.lamps();
    }
    if (lane.kind == world::LaneKind::internal) {
        // Bound to its route, SUMO takes the nearest way through the junction that leads to any
        // edge of the route; when that is not ours it aborts (an assertion of MSLaneChanger's).
        // Free to look, it takes the lane that we name, and forgets the rest of the route.
        place(lane.edge, index, anywhere);
        mirror.lamps = 0xffff;
    } else {
        place(lane.edge, index, on_its_route);
    }
    mirror.edge = edge;
    mirror.after = after;
    at = std::find(mirror.route.begin(), mirror.route.end(), edge);
    mirror.route.erase(mirror.route.begin(), at);
    // The end of the plan comes near: SUMO takes vehicles out at the end of their route.
    if (mirror.route.size() <= 1)
        mirror.lamps = 0xffff;
}

/// SUMO 1.15 keeps lists of the lanes behind that a vehicle's tail lies on, and behind the lane
/// beside that it reaches over. They go stale, and then those who look there for the tail make SUMO
/// abort (an assertion of MSVehicle::getBackPositionOnLane):
/// - inside a junction a moved vehicle's lists stay as they are until the next step has moved
///   everybody: too late where its tail has passed a whole lane of them at once, or the front one;
/// - the lists behind the lane beside are made when it enters a lane, and inside a junction nobody
///   makes them anew until it leaves that one;
/// - one that leaves the road stays in those.
bool Mirrors::lists_go_stale(const std::string& lane,
                             const Mirror& mirror,
                             const world::VehicleState& vehicle,
                             const Target& target) const {
    using libsumo::Vehicle;
    const double driven = step_ * world::to_eigen(vehicle.velocity()).norm();
    if (!target.on_lane && driven > 0.001)
        return true;
    const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
    const double tail = Vehicle::getLanePosition(mirror.sumo) - model.length;
    // The measures of the lanes differ from what is driven, by less than as much again.
    const double just = 0.1 + 2 * driven;
    const auto passes = [tail, just](double end) { return tail < -end + just; };
    const auto here = short_predecessors_.find(lane);
    if (here != short_predecessors_.end() &&
        std::any_of(here->second.ends.begin(), here->second.ends.end(), passes))
        return true;
    const double aside = std::abs(Vehicle::getLateralLanePosition(mirror.sumo)) + model.width / 2;
    return lane.front() == ':' && passes(0) && aside > libsumo::Lane::getWidth(lane) / 2 - 0.05;
}

/// Then it enters its lane anew before the step, which makes the lists again, with nothing on the
/// lane beside. Moved to the lane that it is on it would only get the position: it goes by way of
/// another one, which leaves its route as it is. Not oftener than needed: for a tick its speed, to
/// SUMO, is that of a jump to its place beside the centre line.
void Mirrors::enter_again(const Mirror& mirror,
                          const world::VehicleState& vehicle,
                          const Target& target) const {
    using libsumo::Vehicle;
    const std::string name = Vehicle::getLaneID(mirror.sumo);
    if (name.empty() || !lists_go_stale(name, mirror, vehicle, target))
        return;
    const std::uint32_t lane = lane_named(name);
    if (lane == world::none || graph_->edge_of(lane) == world::none)
        return;
    const std::vector<std::uint32_t>& road = graph_->edge(graph_->edge_of(lane)).lanes;
    const std::uint32_t other = road.front() == lane ? road.back() : road.front();
    if (other == lane)
        return;  // nothing lies beside it
    const double position = Vehicle::getLanePosition(mirror.sumo);
    Vehicle::moveTo(mirror.sumo, town_->lanes[other].name, 0);
    Vehicle::moveTo(mirror.sumo, name, position);
}

/// SUMO sorts a lane's vehicles when they enter it, and a moved one keeps its place in that order.
/// One that comes abreast of others on their own lane gets its new place before the step, so that
/// they look at that one. It does not enter anew: on the lane that it is on, it only gets the
/// place.
void Mirrors::keep_order(const Mirror& mirror,
                         const Target& target,
                         std::span<const Car> cars) const {
    constexpr double abreast = 5;  // [m] closer than cars ever follow each other, front to front
    const bool passes = std::any_of(cars.begin(), cars.end(), [&target](const Car& car) {
        return car.lane == target.lane && !car.sumo.empty() &&
               std::abs(car.lane_position - target.lane_position) < abreast;
    });
    if (passes)
        libsumo::Vehicle::moveTo(mirror.sumo, town_->lanes[target.lane].name, target.lane_position);
}

void Mirrors::advance(const world::TickView& last,
                      std::span<const Car> cars,
                      std::span<const world::VehicleState> beside_sumo,
                      std::span<const std::uint32_t> wrecks) {
    std::span<const world::VehicleState> vehicles = last.vehicles();
    std::vector<world::VehicleState> all;
    if (!beside_sumo.empty()) {
        all.assign(vehicles.begin(), vehicles.end());
        all.insert(all.end(), beside_sumo.begin(), beside_sumo.end());
        std::sort(all.begin(), all.end(), [](const auto& one, const auto& other) {
            return one.id() < other.id();
        });
        vehicles = all;
    }
    // Gone ones first.
    for (const Mirror& mirror : mirrors_)
        if (world::find(vehicles, mirror.id) == nullptr)
            libsumo::Vehicle::remove(mirror.sumo);
    std::erase_if(mirrors_, [&vehicles](const Mirror& mirror) {
        return world::find(vehicles, mirror.id) == nullptr;
    });
    for (const world::VehicleState& vehicle : vehicles) {
        const Target target = target_of(vehicle);
        // A car's own id is SUMO's until the end of the step.
        const bool is_car = world::find(beside_sumo, vehicle.id()) != nullptr;
        const bool was_car = std::binary_search(wrecks.begin(), wrecks.end(), vehicle.id());
        const std::string name = sumo_id(vehicle.id()) + (is_car ? "f" : was_car ? "w" : "");
        Mirror& mirror = find_or_add(vehicle, name, target);
        try {
            enter_again(mirror, vehicle, target);
            move(mirror, vehicle, target);
            if (mirror.edge != world::none)
                keep_order(mirror, target, cars);
        } catch (const libsumo::TraCIException&) {
            // SUMO's map of the place differs from ours (nets with broken connections): let it look
            // for itself. The same in every run.
            mirror.edge = mirror.after = world::none;
            mirror.route.clear();
            libsumo::Vehicle::moveToXY(
                mirror.sumo, "", -1, target.x, target.y, target.angle_deg, anywhere, reach + 2);
        }
    }
}

void Mirrors::add_to(world::Hasher& hasher) const {
    hasher.add(added_);
    hasher.add(std::uint64_t{mirrors_.size()});
    for (const Mirror& mirror : mirrors_) {
        for (const std::uint32_t number : {mirror.id, mirror.edge, mirror.after})
            hasher.add(number);
        hasher.add(mirror.lamps);
        hasher.add(std::span<const std::uint32_t>(mirror.route));
    }
}

}  // namespace reprise::traffic

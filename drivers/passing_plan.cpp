#include "drivers/passing_plan.h"

#include <algorithm>
#include <cmath>

#include "drivers/control/pedals.h"
#include "drivers/control/steering.h"

namespace reprise::drivers {

namespace {

constexpr double from_things = 0.5;      // [m] kept from cars and things
constexpr double from_people = 1.0;      // [m] kept from people and two-wheelers
constexpr double tracking = 0.15;        // [m] that the car may be beside its line
constexpr double from_edge = 0.15;       // [m] kept from the road's edge
constexpr double steering_share = 0.7;   // of the greatest curvature
constexpr double tightest_share = 0.95;  // of one who has waited long, and stands too near
constexpr double tightest_speed = 1.2;   // [m/s] of that one, while it turns out
constexpr double gentle_step = 1.2;      // [m/s^2] to the side
constexpr double quickest_step = 2.0;    // [m/s^2] to the side
constexpr double slow_braking = 2.5;     // [m/s^2] before it
constexpr double longest_step = 45;      // [m]
constexpr double before_them = 0.5;      // [m] from where on it is beside them
constexpr double behind_them = 1.0;      // [m]
constexpr double before_junction = 1;    // [m]
constexpr double past_people = 5;        // [m/s]
constexpr double brisk = 6;              // [m/s] of one who turned out slowly, for want of room
constexpr double past_things = 9;        // [m/s]
constexpr double past_two_wheelers = 7;  // [m/s] faster than they are
constexpr double spare_time = 2.5;       // [s] before somebody who comes
constexpr double follower_time = 4.5;    // [s] that somebody faster needs to see us and slow down
constexpr double pace = 1.2;             // [m/s^2] with which we get going
constexpr double longest_row = 40;       // [m]
constexpr int most_in_row = 8;
constexpr double long_wait = 12;     // [s] then those who stand wait for the same thing as we
constexpr double over_junction = 3;  // [m/s] where no lanes tell who may come
constexpr double on_road = 0.3;      // [m] that the surfaces of lanes may leave between them
constexpr double from_poles = 0.2;   // [m]

double sharpest_step(const world::VehicleModel& model, double share = steering_share) {
    return share * std::tan(model.max_steering_angle) / model.wheelbase;
}

bool overlaps(double low, double high, double other_low, double other_high) {
    return low < other_high && other_low < high;
}

/// The row that is passed at once.
struct Row {
    double rear = 0, front = 0;
    double right = 0, left = 0;  ///< with what is kept from them
    double along = 0;            ///< [m/s] the fastest
    double speed = world::infinity;

    void take(const Neighbour& one, bool is_first) {
        const double kept = clearance_of(one);
        rear = is_first ? one.rear : std::min(rear, one.rear);
        front = is_first ? one.front : std::max(front, one.front);
        right = is_first ? one.right - kept : std::min(right, one.right - kept);
        left = is_first ? one.left + kept : std::max(left, one.left + kept);
        along = std::max({along, one.along, 0.0});
        const double most = one.body.kind == BodyKind::walker        ? past_people
                            : one.body.kind == BodyKind::two_wheeler ? past_two_wheelers
                                                                     : past_things;
        speed = std::min(speed, most + std::max(one.along, 0.0));
    }
};

/// The lane under the path there; none inside junctions.
const PathPiece* piece_at(const Way& way, double s) {
    for (const PathPiece& piece : way.pieces())
        if (s <= piece.end)
            return &piece;
    return nullptr;
}

double next_gate(const Way& way, double s) {
    for (const Gate& gate : way.gates())
        if (gate.s > s)
            return gate.s;
    return way.path().end();
}

/// Does anybody of the other direction come before we are back? Lanes tell for those who follow
/// them, from around corners too.
bool somebody_comes(const PassingScene& scene, const PassingPlan& plan) {
    const double s = scene.tracked_s();
    const double back = plan.bypass.back_end;
    const double time =
        travel_time(back - s, scene.ego.speed, pace * scene.share, plan.speed) + spare_time;
    const LaneGraph& graph = scene.map.graph;
    const world::TownT& town = graph.town();
    const auto reach = [&](double speed, double limit) {
        const double top = std::max(speed, limit);
        const double speeding_up = std::min((top - speed) / 2.0, time);
        return speed * time + 2.0 * speeding_up * (time - speeding_up / 2);
    };
    for (const Neighbour& one : scene.neighbours) {
        const bool towards_us = one.along < -0.3 && one.left > -8 && one.right < 8;
        if (towards_us && one.front > s && one.rear - back < reach(-one.along, -one.along))
            return true;
    }
    const PathPiece* piece = piece_at(scene.way, s);
    if (piece == nullptr)
        return false;
    const auto inner = town.left_hand ? &world::LaneT::right : &world::LaneT::left;
    std::uint32_t lane = piece->lane;
    while (town.lanes[lane].*inner < town.lanes.size())
        lane = town.lanes[lane].*inner;
    const std::uint32_t opposite = town.lanes[lane].opposite;
    if (opposite >= town.lanes.size())
        return false;
    const double limit = town.lanes[opposite].speed_limit;
    const double goal = world::project(town.lanes[opposite], scene.way.path().at(back).position).s;
    const double behind_us =
        world::project(town.lanes[opposite], scene.way.path().at(s).position).s;
    const auto comes = [&](std::uint32_t on, double at, double speed) {
        if (on >= town.lanes.size() || (plan.past_waiting && speed < 0.3))
            return false;
        if (on == opposite && at > goal)
            return at < behind_us && speed > 0.3;
        const double most = reach(speed, std::max(limit, speed));
        return distance_along_lanes(graph, on, at, opposite, goal, most) < most;
    };
    for (const world::CarState& car : scene.last.cars())
        if (comes(car.lane(), static_cast<double>(car.lane_s()), static_cast<double>(car.speed())))
            return true;
    for (const world::VehicleState& other : scene.last.vehicles()) {
        const world::Measurement* measured = world::find(scene.last.measurements(), other.id());
        if (other.id() == scene.ego.id || measured == nullptr)
            continue;
        const Ego seen = ego_of(other);
        // Who stands with the hazard lights on does not come along it.
        if (has_hazard_lights(other.lamps()) && std::abs(seen.speed) < 0.3)
            continue;
        if (comes(measured->lane(),
                  measured->lane_s() + seen.model->length - seen.model->rear_overhang,
                  measured->speed()))
            return true;
    }
    return false;
}

/// Beside us, or behind and faster, where we want to go?
bool somebody_follows(const PassingScene& scene, const PassingPlan& plan) {
    const double half = scene.ego.model->width / 2 + 0.4;
    const double low = std::min(plan.bypass.aside, scene.beside) - half;
    const double high = std::max(plan.bypass.aside, scene.beside) + half;
    return std::any_of(scene.neighbours.begin(), scene.neighbours.end(), [&](const Neighbour& one) {
        const bool own = overlaps(one.right,
                                  one.left,
                                  scene.beside - scene.ego.model->width / 2,
                                  scene.beside + scene.ego.model->width / 2);
        if (own || !overlaps(one.right, one.left, low, high) || one.along < 0)
            return false;
        if (one.rear > scene.ego.front_s() + 1)
            return false;
        if (one.front > scene.ego.rear_s() - 1)
            return true;
        const double closing = std::max(one.along - scene.ego.speed, 0.0);
        return !one.stands() &&
               scene.ego.rear_s() - one.front < 2.5 + 0.5 * one.along + follower_time * closing;
    });
}

/// The line past the row on one side; nothing is looked at but the row.
/// [m/s] at most.
PassingPlan line_past(const PassingScene& scene, const Row& row, bool to_left, double most) {
    const world::VehicleModel& model = *scene.ego.model;
    const double half = model.width / 2 + tracking;
    PassingPlan plan;
    Bypass& way = plan.bypass;
    way.from = scene.beside;
    way.aside = to_left ? row.left + half : row.right - half;
    // On the other side already: it is enough to stay there.
    way.aside = to_left ? std::max(way.aside, 0.0) : std::min(way.aside, 0.0);
    const double width = way.aside - way.from;
    const double s = scene.tracked_s();
    const double limit = std::sqrt(scene.share * scene.way.path().at(s).squared_speed);
    plan.speed = std::min({row.speed, std::max(limit, 3.0), most});

    double least = Bypass::shortest_step(width, sharpest_step(model));
    way.out_end = row.rear - before_them;
    const double ahead = way.out_end - s;
    plan.room = least + before_them + 0.3 - scene.to_front();
    const bool is_tight = least > ahead && scene.waited > long_wait;
    if (is_tight)
        least = Bypass::shortest_step(width, sharpest_step(model, tightest_share));
    plan.missing = std::max(least - ahead, 0.0);
    const double wanted =
        step_length(model, width, std::min(scene.ego.speed, plan.speed), scene.share);
    const double length = std::clamp(ahead, std::min(least, wanted), wanted);
    way.out_start = way.out_end - length;
    plan.out_speed =
        std::min(plan.speed, Bypass::fastest(width, length, quickest_step * scene.share));
    plan.speed = std::min({plan.speed, std::max(plan.out_speed, brisk), most});
    if (is_tight)
        plan.out_speed = std::min(plan.out_speed, tightest_speed);

    // Those who go on are some metres farther when we have passed them.
    way.back_start = row.front + scene.to_rear() + behind_them;
    if (row.along > 0.3) {
        const double gain = std::max(plan.speed - row.along, 1.0);
        way.back_start += row.along * (way.back_start - s) / gain + row.along;
    }
    way.back_end = way.back_start + step_length(model, way.aside, plan.speed, scene.share);
    return plan;
}

/// What the plan takes of the road; none: it has not got it.
std::optional<PassingPlan::Uses> road_for(const PassingScene& scene,
                                          const PassingPlan& plan,
                                          bool to_left) {
    const double s = scene.tracked_s();
    const PathPiece* piece = piece_at(scene.way, s);
    if (piece == nullptr)
        return std::nullopt;
    const RoadWidth road = road_width(scene.map.town, piece->lane);
    const double needed = std::abs(plan.bypass.aside) + scene.ego.model->width / 2 + from_edge;
    if (needed <= (to_left ? road.lane_left : road.lane_right))
        return PassingPlan::Uses::own_lane;
    if (plan.bypass.back_end > std::min(piece->end, next_gate(scene.way, s) - before_junction))
        return std::nullopt;
    if (needed <= (to_left ? road.own_left : road.own_right))
        return PassingPlan::Uses::next_lane;
    if (needed <= (to_left ? road.road_left : road.road_right))
        return PassingPlan::Uses::oncoming_lane;
    return std::nullopt;
}

/// Does anything of the town stand beside the path where the line leads? On the path nothing does.
bool meets_the_town(const PassingScene& scene, const PassingPlan& plan) {
    constexpr double step = 2;      // [m]
    constexpr double beside = 0.3;  // [m] from there on it is not the path
    const Path& path = scene.way.path();
    const double reach = scene.ego.model->width / 2 + from_poles;
    const double end = std::min(plan.bypass.back_end + scene.to_front(), path.end());
    const auto at = [&](double s) {
        const PathPoint here = path.at(s);
        const Eigen::Vector3d left(-here.direction.y(), here.direction.x(), 0);
        return Eigen::Vector3d(here.position + plan.bypass.offset(s) * left);
    };
    for (double s = std::max(plan.bypass.out_start, scene.tracked_s()); s < end; s += step)
        if (std::abs(plan.bypass.offset(s)) > beside &&
            !scene.map.clearances.is_clear(at(s), at(s + step), reach))
            return true;
    return false;
}

/// Who looks for his way anew in the midst of a junction has no gate of it on that.
bool is_in_junction(const PassingScene& scene) {
    const PathPiece* piece = piece_at(scene.way, scene.tracked_s());
    return piece != nullptr && scene.map.town.lanes[piece->lane].kind == world::LaneKind::internal;
}

bool reaches_junction(const PassingScene& scene, const PassingPlan& plan) {
    const auto& gates = scene.way.gates();
    return is_in_junction(scene) || std::any_of(gates.begin(), gates.end(), [&](const Gate& gate) {
               return gate.s - before_junction < plan.bypass.back_end &&
                      gate.exit_s > scene.tracked_s();
           });
}

/// Is there road under all of the car, all along the line? Junctions have no lanes beside each
/// other, but ways over them in all directions.
bool lies_on_road(const PassingScene& scene, const PassingPlan& plan) {
    constexpr double step = 2;  // [m]
    const Path& path = scene.way.path();
    const double half = scene.ego.model->width / 2;
    if (plan.bypass.back_end > path.end() - 1)
        return false;
    for (double s = scene.tracked_s(); s < plan.bypass.back_end + step; s += step) {
        const PathPoint here = path.at(s);
        const Eigen::Vector3d left(-here.direction.y(), here.direction.x(), 0);
        const Eigen::Vector3d middle = here.position + plan.bypass.offset(s) * left;
        for (const double side : {-1.0, 1.0}) {
            const Eigen::Vector3d edge = middle + side * (half + from_edge) * left;
            if (scene.map.lanes.at(edge, on_road).empty() ||
                scene.map.clearances.look(middle, side * left.head<2>()).to_obstacle <
                    half + from_poles)
                return false;
        }
    }
    return true;
}

enum class Met : std::uint8_t { nobody, thing, somebody };

/// Who else is in the way of the plan?
Met meets(const PassingScene& scene,
          const PassingPlan& plan,
          const Row& row,
          const Neighbour& one) {
    if (one.front < scene.ego.front_s() || !one.stands())
        return Met::nobody;
    const double half = scene.ego.model->width / 2 + 0.1;
    const double kept = std::min(clearance_of(one), 0.4);
    const double from = std::max(one.rear - scene.to_front(), scene.tracked_s());
    const double to = one.front + scene.to_rear();
    for (double s = from; s < std::min(to, plan.bypass.back_end + 2); s += 0.5) {
        const double offset = plan.bypass.offset(s);
        if (overlaps(one.right - kept, one.left + kept, offset - half, offset + half))
            return one.body.abandoned && one.rear > row.rear - 3 ? Met::thing : Met::somebody;
    }
    return Met::nobody;
}

/// On one side, with all who turn out to be in the way.
std::optional<PassingPlan> plan_side(const PassingScene& scene,
                                     const Neighbour& first,
                                     bool to_left) {
    Row row;
    row.take(first, true);
    const bool stays = first.stands() && (first.body.abandoned || faces_us(first, scene.way));
    std::vector<std::uint32_t> ids{first.body.id};
    for (int round = 0; round < most_in_row; ++round) {
        PassingPlan plan = line_past(scene, row, to_left, world::infinity);
        auto uses = road_for(scene, plan, to_left);
        if (!uses && stays) {
            plan = line_past(scene, row, to_left, over_junction);
            if (reaches_junction(scene, plan) && lies_on_road(scene, plan))
                uses = PassingPlan::Uses::junction;
        }
        if (!uses || row.front - row.rear > longest_row)
            return std::nullopt;
        if (meets_the_town(scene, plan))
            return std::nullopt;
        plan.uses = *uses;
        bool grown = false;
        for (const Neighbour& one : scene.neighbours) {
            const bool is_door = one.body.kind == BodyKind::door;
            if (!is_door && std::find(ids.begin(), ids.end(), one.body.id) != ids.end())
                continue;
            const Met met = meets(scene, plan, row, one);
            if (met == Met::somebody)
                return std::nullopt;
            if (met == Met::thing) {
                row.take(one, false);
                ids.push_back(one.body.id);
                grown = true;
                break;
            }
        }
        if (grown)
            continue;
        plan.row = std::move(ids);
        plan.past_waiting = scene.waited > long_wait;
        // Too fast to turn out so soon: later, when it has slowed down.
        const double braking =
            (scene.ego.speed * scene.ego.speed - plan.out_speed * plan.out_speed) /
            (2 * slow_braking * scene.share);
        const double until = plan.bypass.out_start - scene.tracked_s() +
                             0.3 * (plan.bypass.out_end - plan.bypass.out_start);
        plan.is_free = braking <= std::max(until, 0.0) && is_free(scene, plan);
        return plan;
    }
    return std::nullopt;
}

}  // namespace

double PassingScene::tracked_s() const {
    return ego.rear_axle_s + tracked_ahead(*ego.model);
}

double PassingScene::to_front() const {
    return ego.model->length - ego.model->rear_overhang - tracked_ahead(*ego.model);
}

double PassingScene::to_rear() const {
    return ego.model->rear_overhang + tracked_ahead(*ego.model);
}

bool faces_us(const Neighbour& one, const Way& way) {
    return one.body.kind == BodyKind::vehicle && one.stands() &&
           one.body.direction.dot(way.path().at(one.rear).direction) < -0.5;
}

double clearance_of(const Neighbour& one) {
    return one.body.kind == BodyKind::walker || one.body.kind == BodyKind::two_wheeler
               ? from_people
               : from_things;
}

double step_length(const world::VehicleModel& model, double width, double speed, double share) {
    const double least = Bypass::shortest_step(width, sharpest_step(model));
    const double gentle = speed / Bypass::fastest(width, 1, gentle_step * share);
    return std::max(least, std::min(gentle, longest_step));
}

bool is_free(const PassingScene& scene, const PassingPlan& plan) {
    if (plan.uses == PassingPlan::Uses::own_lane)
        return true;
    if (somebody_follows(scene, plan))
        return false;
    return plan.uses == PassingPlan::Uses::next_lane || !somebody_comes(scene, plan);
}

std::optional<PassingPlan> plan_passing(const PassingScene& scene, const Neighbour& first) {
    std::optional<PassingPlan> best;
    const auto cost = [&](const PassingPlan& plan) {
        // Two who meet nose to nose both go around on the side on which they drive.
        const bool wrong_side =
            (plan.bypass.aside > 0) != scene.map.town.left_hand && faces_us(first, scene.way);
        return std::abs(plan.bypass.aside) + (plan.is_free ? 0 : 2) + (wrong_side ? 10 : 0) +
               3 * static_cast<double>(plan.uses);
    };
    for (const bool to_left : {true, false}) {
        std::optional<PassingPlan> plan = plan_side(scene, first, to_left);
        if (plan && (!best || cost(*plan) < cost(*best)))
            best = std::move(plan);
    }
    return best;
}

}  // namespace reprise::drivers

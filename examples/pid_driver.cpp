// The PID driver of the CARLA paper's modular pipeline (Dosovitskiy et al., CoRL 2017,
// section 3.1): 20 km/h along waypoints; here those of its lane, straight on at junctions. It stops
// at red and behind others.
//     reprise run examples/external.lua --driver ego=pid_driver
#include <algorithm>
#include <cmath>
#include <numbers>

#include "remote/client.h"
#include "world/town.h"

using namespace reprise;

/// Gains as of a controller of percent: error in, share of the pedal or of the wheel out.
class Pid {
  public:
    Pid(double p, double i, double d) : p_(p), i_(i), d_(d) {}

    double operator()(double error, double step) {
        sum_ = std::clamp(sum_ + error * step, -5.0, 5.0);
        const double change = (error - last_) / step;
        last_ = error;
        return p_ * error + i_ * sum_ + d_ * change;
    }

  private:
    double p_, i_, d_, sum_ = 0, last_ = 0;
};

/// Where the way leads behind a lane: the way that turns least.
const world::Link* onwards(const world::LaneT& lane) {
    const auto least = std::min_element(
        lane.links.begin(), lane.links.end(), [](const world::Link& one, const world::Link& other) {
            return one.turn() < other.turn();
        });
    return least == lane.links.end() ? nullptr : &*least;
}

/// [rad] left positive, from the vehicle's nose to the way so many metres ahead.
double angle_to_way(const world::TownT& town,
                    const world::VehicleState& ego,
                    const world::Measurement& own,
                    double ahead) {
    std::uint32_t lane = own.lane();
    double s = own.lane_s() + ahead;
    while (s > town.lanes[lane].length && onwards(town.lanes[lane]) != nullptr) {
        s -= town.lanes[lane].length;
        const world::Link& link = *onwards(town.lanes[lane]);
        lane = link.via() != world::none ? link.via() : link.to();
    }
    const Eigen::Vector3d point = world::point_at(town.lanes[lane], s).position;
    const world::Quat& q = ego.orientation();
    const double yaw =
        std::atan2(2 * (q.w() * q.z() + q.x() * q.y()), 1 - 2 * (q.y() * q.y() + q.z() * q.z()));
    const double angle =
        std::atan2(point.y() - ego.position().y(), point.x() - ego.position().x()) - yaw;
    return std::remainder(angle, 2 * std::numbers::pi);
}

/// [m] that are free: to the one ahead, or to a signal that is not green.
double free_way(const world::TownT& town,
                const world::TickView& tick,
                const world::Measurement& own) {
    double free = own.gap_ahead() - 5;
    const world::LaneT& lane = town.lanes[own.lane()];
    const world::Link* link = onwards(lane);
    if (link != nullptr && link->signal() != world::none) {
        const world::SignalColor color = tick.signals()[link->signal()];
        if (color == world::SignalColor::red || color == world::SignalColor::yellow ||
            color == world::SignalColor::red_yellow)
            free = std::min(free, lane.length - own.lane_s() - 6);
    }
    return std::max(free, 0.0);
}

int main() {
    remote::Client run;
    Pid pedals(0.35, 0.03, 0.0), wheel(1.2, 0.0, 0.05);
    while (const auto tick = run.next()) {
        const world::VehicleState* ego = world::find(tick->vehicles(), run.actor());
        const world::Measurement* own = world::find(tick->measurements(), run.actor());
        if (ego == nullptr || own == nullptr || own->lane() == world::none) {
            run.say({.brake = 1});
            continue;
        }
        const double comfortable = std::sqrt(2 * 2.0 * free_way(run.town(), *tick, *own));
        const double push = pedals(std::min(20 / 3.6, comfortable) - own->speed(), run.step());
        const double steer =
            wheel(angle_to_way(run.town(), *ego, *own, 4 + 0.5 * own->speed()), run.step());
        run.say({.throttle = std::clamp(push, 0.0, 1.0),
                 .brake = comfortable < 0.5 ? 1.0 : std::clamp(-push, 0.0, 1.0),
                 .steer = std::clamp(steer, -1.0, 1.0)});
    }
}

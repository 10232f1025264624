#include "replay/score/watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "world/frames.h"
#include "world/lanes/junctions.h"

namespace reprise::replay {

namespace {

constexpr double one_episode = 0.5;  ///< [s] ticks that are nearer to each other

std::vector<std::uint32_t> lanes_at_stop_signs(const world::TownT& town) {
    std::vector<std::uint32_t> lanes;
    for (const auto& arms : world::arms_of_junctions(town))
        for (const world::JunctionArm& arm : arms)
            if (arm.stop_sign)
                lanes.insert(lanes.end(), arm.incoming.begin(), arm.incoming.end());
    std::sort(lanes.begin(), lanes.end());
    lanes.erase(std::unique(lanes.begin(), lanes.end()), lanes.end());
    return lanes;
}

}  // namespace

DrivenTown::DrivenTown(const world::TownT& driven)
    : town(driven),
      signal_lines(driven),
      sign_lines(driven, lanes_at_stop_signs(driven)) {}

Eigen::Vector3d Sight::position() const {
    return world::to_eigen(vehicle.position());
}

double Sight::yaw() const {
    const Eigen::Vector3d ahead = world::to_eigen(vehicle.orientation()).toRotationMatrix().col(0);
    return std::atan2(ahead.y(), ahead.x());
}

Sight see(const world::TickView& tick,
          const world::VehicleState& vehicle,
          const world::Measurement& measured,
          double step,
          LastSeen& last) {
    Sight sight{tick, vehicle, measured, world::vehicle_models()[vehicle.model()], step};
    if (last.is_known) {
        sight.driven = std::abs(vehicle.odometer() - last.odometer);
        sight.is_put =
            (sight.position() - last.position).norm() > Sight::farthest(measured.speed(), step);
    }
    last = {true, vehicle.odometer(), sight.position()};
    return sight;
}

bool is_driven(const world::Spawns& spawns, std::uint32_t vehicle) {
    const auto spawn = spawns.find(vehicle);
    if (spawn == spawns.end())
        return false;  // of the demand's
    const world::Driver driver = spawn->second.command.driver;
    return driver == world::Driver::autopilot || driver == world::Driver::manual ||
           driver == world::Driver::external;
}

std::vector<Infraction> Watch::take_begun() {
    return std::exchange(begun_, {});
}

std::vector<Infraction> Watch::take() {
    return std::exchange(ended_, {});
}

Infraction Watch::begun(InfractionKind kind, const Sight& sight, double worst) {
    Infraction infraction;
    infraction.kind = kind;
    infraction.actor = sight.vehicle.id();
    infraction.first = infraction.last = sight.index();
    infraction.worst = worst;
    infraction.lane = sight.measured.lane();
    infraction.position = sight.position();
    return infraction;
}

void LastingWatch::look(const Sight& sight) {
    step_ = sight.step;
    const std::optional<double> now = value(sight);
    if (open_ && static_cast<double>(sight.index() - open_->last) * step_ >= one_episode)
        finish();
    if (!now)
        return;
    if (open_) {
        open_->last = sight.index();
        open_->worst = adds_up() ? open_->worst + *now : std::max(open_->worst, *now);
    } else {
        open_ = begun(kind_, sight, *now);
    }
    if (!is_sure_ && is_long_enough()) {
        is_sure_ = true;
        begin(*open_);
    }
}

bool LastingWatch::is_long_enough() const {
    return static_cast<double>(open_->last - open_->first + 1) * step_ >= shortest_;
}

void LastingWatch::finish() {
    if (is_sure_)
        end(*open_);
    open_.reset();
    is_sure_ = false;
}

}  // namespace reprise::replay

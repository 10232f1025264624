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
    if (!open_) {
        open_ = begun(kind_, sight, *now);
        return;
    }
    open_->last = sight.index();
    open_->worst = adds_up() ? open_->worst + *now : std::max(open_->worst, *now);
}

void LastingWatch::finish() {
    if (open_ && static_cast<double>(open_->last - open_->first + 1) * step_ >= shortest_)
        end(*open_);
    open_.reset();
}

}  // namespace reprise::replay

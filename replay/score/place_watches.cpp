// Watches for where a vehicle is, and for what happens to it.
#include <algorithm>
#include <cmath>

#include "replay/score/watches.h"
#include "world/blockage.h"

namespace reprise::replay {

namespace {

constexpr double counting_share = 0.3;  ///< of the footprint: Dosovitskiy et al., CoRL 2017
constexpr double most_of_it = 0.5;
constexpr double on_its_way = 0.5;           ///< [m/s]
constexpr std::uint8_t terrain_surface = 0;  ///< of WheelState.surface: neither road nor sidewalk
constexpr int wheels_off_road = 2;

int wheels_on_terrain(const Sight& sight) {
    return static_cast<int>(std::count_if(sight.tick.wheels().begin(),
                                          sight.tick.wheels().end(),
                                          [&](const world::WheelState& wheel) {
                                              return wheel.vehicle() == sight.vehicle.id() &&
                                                     wheel.in_contact() &&
                                                     wheel.surface() == terrain_surface;
                                          }));
}

}  // namespace

std::optional<double> ShareWatch::value(const Sight& sight) {
    const double share = kind_ == InfractionKind::sidewalk ? sight.measured.on_sidewalk()
                                                           : sight.measured.on_opposite_lane();
    return share > counting_share ? std::optional(share) : std::nullopt;
}

std::optional<double> WrongWayWatch::value(const Sight& sight) {
    if (sight.measured.on_opposite_lane() <= most_of_it || sight.measured.speed() < on_its_way)
        return std::nullopt;
    return sight.driven;
}

std::optional<double> OffRoadWatch::value(const Sight& sight) {
    if (wheels_on_terrain(sight) < wheels_off_road)
        return std::nullopt;
    return sight.driven;
}

bool is_off_lane(const Sight& sight) {
    return sight.measured.on_opposite_lane() > most_of_it ||
           sight.measured.on_sidewalk() > most_of_it || wheels_on_terrain(sight) >= wheels_off_road;
}

InfractionKind CollisionWatch::kind_of(const Sight& sight, std::uint32_t other) const {
    if (other == 0 || world::find(sight.tick.props(), other) != nullptr)
        return InfractionKind::collision_static;
    if (sight.tick.traffic != nullptr && world::find(sight.tick.walkers(), other) != nullptr)
        return InfractionKind::collision_pedestrian;
    // Who was taken away at once, or a trace without its traffic: what the impulse was added to.
    const bool has_body =
        world::find(sight.tick.vehicles(), other) != nullptr ||
        (sight.tick.traffic != nullptr && world::find(sight.tick.cars(), other) != nullptr);
    return !has_body && sight.measured.impulse_walkers() > impulse_walkers_
               ? InfractionKind::collision_pedestrian
               : InfractionKind::collision_vehicle;
}

void CollisionWatch::look(const Sight& sight) {
    const std::uint32_t own = sight.vehicle.id();
    if (sight.tick.tick->events() != nullptr)
        for (const world::Event* event : *sight.tick.tick->events()) {
            const bool begins = event->kind() == world::EventKind::collision;
            if ((!begins && event->kind() != world::EventKind::collision_ended) ||
                (event->actor() != own && event->other() != own))
                continue;
            const std::uint32_t other = event->actor() == own ? event->other() : event->actor();
            if (begins) {
                Infraction infraction = begun(kind_of(sight, other), sight, event->value());
                infraction.other = other;
                open_[other] = infraction;
            } else if (const auto open = open_.find(other); open != open_.end()) {
                // Within the run, whatever number a file holds.
                const double lasted = std::min(static_cast<double>(sight.index()),
                                               std::round(event->duration() / sight.step));
                const auto ticks = static_cast<std::uint64_t>(std::max(1.0, lasted));
                open->second.last = std::min(sight.index(), open->second.first + ticks - 1);
                open->second.worst = std::max(open->second.worst, event->value());
                end(open->second);
                open_.erase(open);
            }
        }
    impulse_walkers_ = sight.measured.impulse_walkers();
    last_ = sight.index();
}

void CollisionWatch::finish() {
    for (auto& [other, infraction] : open_) {
        infraction.last = last_;
        end(infraction);
    }
    open_.clear();
}

void BlockedWatch::look(const Sight& sight) {
    const auto step_ns = static_cast<std::uint64_t>(std::llround(sight.step * 1e9));
    const std::uint64_t halted = sight.measured.halted_ticks();
    if (!world::is_blocked(sight.measured, step_ns)) {
        finish();
        return;
    }
    const double stood = static_cast<double>(halted) * sight.step;
    if (!open_) {
        open_ = begun(InfractionKind::blocked, sight, stood);
        open_->first = sight.index() - std::min(sight.index() - 1, halted - 1);
    }
    open_->last = sight.index();
    open_->worst = stood;
}

void BlockedWatch::finish() {
    if (open_)
        end(*open_);
    open_.reset();
}

std::vector<std::unique_ptr<Watch>> all_watches(const DrivenTown& town) {
    std::vector<std::unique_ptr<Watch>> watches;
    watches.push_back(std::make_unique<CollisionWatch>());
    watches.push_back(std::make_unique<ShareWatch>(InfractionKind::opposite_lane));
    watches.push_back(std::make_unique<ShareWatch>(InfractionKind::sidewalk));
    watches.push_back(std::make_unique<RedLightWatch>(town));
    watches.push_back(std::make_unique<StopSignWatch>(town));
    watches.push_back(std::make_unique<SpeedWatch>(town));
    watches.push_back(std::make_unique<WrongWayWatch>());
    watches.push_back(std::make_unique<OffRoadWatch>());
    watches.push_back(std::make_unique<BlockedWatch>());
    return watches;
}

}  // namespace reprise::replay

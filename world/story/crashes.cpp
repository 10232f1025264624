#include "world/story/crashes.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Core>
#include <fmt/format.h>

#include "world/frames.h"
#include "world/story/wording.h"

namespace reprise::world {

namespace {

struct Moving {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();
    Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< [m/s]
};

/// Of a car or a walker, which know their speed along their heading.
template <typename State>
Moving along_heading(const State& state) {
    const double yaw = state.yaw();
    const double speed = state.speed();
    return {to_eigen(state.position()).template head<2>(),
            Eigen::Vector2d(std::cos(yaw), std::sin(yaw)) * speed};
}

std::optional<Moving> find_moving(std::uint32_t id,
                                  std::span<const VehicleState> vehicles,
                                  std::span<const CarState> cars,
                                  std::span<const WalkerState> walkers) {
    if (const VehicleState* vehicle = find(vehicles, id))
        return Moving{to_eigen(vehicle->position()).head<2>(),
                      to_eigen(vehicle->velocity()).head<2>()};
    if (const CarState* car = find(cars, id))
        return along_heading(*car);
    if (const WalkerState* walker = find(walkers, id))
        return along_heading(*walker);
    return std::nullopt;
}

/// How fast `self` comes closer to `other` by itself. [m/s]
double approach(const Moving& self, const Moving& other) {
    return self.velocity.dot((other.position - self.position).normalized());
}

}  // namespace

void ActorNames::know(std::uint32_t id, const std::string& name) {
    named_.insert_or_assign(id, Named{name, true});
}

void ActorNames::hear(const TickView& tick) {
    if (tick.tick->events() == nullptr)
        return;
    for (const Event* event : *tick.tick->events())
        if (event->kind() == EventKind::spawned && event->text() != nullptr)
            named_[event->actor()] = {event->text()->str(), event->actor() < first_background_id};
}

std::string ActorNames::name_of(std::uint32_t id) const {
    if (id == 0)
        return "something fixed";
    const auto named = named_.find(id);
    if (named == named_.end())
        return fmt::format("actor {}", id);
    if (named->second.is_name)
        return named->second.text;
    return fmt::format("{} ({})", with_article("passing " + named->second.text), id);
}

const std::string* ActorNames::given(std::uint32_t id) const {
    const auto named = named_.find(id);
    return named != named_.end() && named->second.is_name ? &named->second.text : nullptr;
}

std::string to_line(const Crash& crash) {
    std::string line = fmt::format("{} hits {}", crash.who, crash.whom);
    if (crash.speed)
        line += fmt::format(" at {} m/s", with_decimals(*crash.speed, 1));
    if (crash.impulse > 0)
        line += fmt::format(": {} N s", with_thousands(crash.impulse));
    if (crash.duration > 0)
        line += fmt::format(", in contact for {} s", with_decimals(crash.duration, 2));
    return line;
}

std::vector<Crash> CrashStory::hear(const TickView& tick) {
    names_.hear(tick);
    std::vector<Crash> ended;
    if (tick.tick->events() != nullptr)
        for (const Event* event : *tick.tick->events()) {
            if (event->kind() == EventKind::collision)
                open_.push_back(begun(*event, tick.index()));
            if (event->kind() != EventKind::collision_ended)
                continue;
            const auto crash = std::find_if(open_.begin(), open_.end(), [&](const Crash& known) {
                return known.actor == event->actor() && known.other == event->other();
            });
            if (crash == open_.end())
                continue;  // it began before what is heard
            crash->impulse = event->value();
            crash->duration = event->duration();
            ended.push_back(std::move(*crash));
            open_.erase(crash);
        }
    const auto keep = [](auto& kept, auto states) { kept.assign(states.begin(), states.end()); };
    keep(vehicles_, tick.vehicles());
    keep(cars_, tick.traffic == nullptr ? std::span<const CarState>() : tick.cars());
    keep(walkers_, tick.traffic == nullptr ? std::span<const WalkerState>() : tick.walkers());
    last_tick_ = tick.index();
    return ended;
}

/// Told by how the two moved in the tick before: in that of the event they have hit already.
Crash CrashStory::begun(const Event& event, std::uint64_t tick) const {
    Crash crash{event.actor(), event.other(), "", "", tick, {}, event.value(), 0};
    const auto moving = [&](std::uint32_t id) {
        return last_tick_ + 1 == tick ? find_moving(id, vehicles_, cars_, walkers_) : std::nullopt;
    };
    const auto actor = moving(event.actor());
    const auto other = moving(event.other());
    if (actor && event.other() == 0)
        crash.speed = actor->velocity.norm();
    if (actor && other)
        crash.speed = (actor->velocity - other->velocity).norm();
    const bool is_hit = actor && other && approach(*other, *actor) > approach(*actor, *other);
    crash.who = names_.name_of(is_hit ? event.other() : event.actor());
    crash.whom = names_.name_of(is_hit ? event.actor() : event.other());
    return crash;
}

}  // namespace reprise::world

#include "replay/noun_check.h"

#include <algorithm>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "replay/struct_vector.h"
#include "world/episode_generated.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/tick.h"

namespace reprise::replay {

namespace {

/// Strictly ascending keys.
template <typename T, typename Key>
bool ascending(std::span<const T> range, Key key) {
    for (std::size_t i = 1; i < range.size(); ++i) {
        if (!(key(range[i - 1]) < key(range[i])))
            return false;
    }
    return true;
}

constexpr auto id_of = [](const auto& item) { return item.id(); };
constexpr auto actor_of = [](const auto& item) { return item.actor(); };

bool vectors_are_sound(const world::Tick& tick) {
    return tick.commands() != nullptr && tick.events() != nullptr && tick.signals() != nullptr &&
           is_aligned(tick.controls()) && is_aligned(tick.vehicles()) &&
           is_aligned(tick.wheels()) && is_aligned(tick.measurements()) &&
           is_aligned(tick.looks()) && is_aligned(tick.props()) && is_aligned(tick.doors()) &&
           std::all_of(tick.commands()->begin(), tick.commands()->end(), [](const auto* command) {
               return is_aligned(command->path());
           });
}

bool sorted(const world::TickView& view) {
    return ascending(view.controls(), actor_of) && ascending(view.vehicles(), id_of) &&
           ascending(view.measurements(), actor_of) && ascending(view.vehicle_looks(), actor_of) &&
           ascending(view.wheels(),
                     [](const world::WheelState& wheel) {
                         return std::tuple(wheel.vehicle(), wheel.index());
                     }) &&
           ascending(view.props(), id_of) && ascending(view.doors(), [](const world::Door& door) {
               return std::tuple(door.actor(), door.door());
           });
}

bool known_enumerators(const world::Command& command) {
    return command.kind() <= world::CommandKind::MAX && command.driver() <= world::Driver::MAX &&
           command.shape() <= world::Shape::MAX && command.color() <= world::SignalColor::MAX;
}

bool known_enumerators(const world::Tick& tick) {
    for (const auto* command : *tick.commands()) {
        if (!known_enumerators(*command))
            return false;
    }
    for (const auto* event : *tick.events()) {
        if (event->kind() > world::EventKind::MAX)
            return false;
    }
    for (const std::uint8_t color : std::span(tick.signals()->Data(), tick.signals()->size())) {
        if (color > static_cast<std::uint8_t>(world::SignalColor::MAX))
            return false;
    }
    return true;
}

bool structs_present(const world::Command& command) {
    return command.target() != nullptr && command.control() != nullptr &&
           command.weather() != nullptr;
}

/// A command without its control, say, is one of another kind; but an event always has a place.
bool structs_present(const world::Tick& tick) {
    for (const auto* event : *tick.events()) {
        if (event->position() == nullptr)
            return false;
    }
    for (const auto* command : *tick.commands()) {
        if (!structs_present(*command))
            return false;
    }
    return true;
}

}  // namespace

std::optional<std::string> fault_of_tick(mcap::View bytes, std::uint64_t index) {
    auto check = verifier(bytes);
    if (!world::VerifyTickBuffer(check))
        return "not a Tick";
    const world::Tick& tick = *world::GetTick(bytes.data());
    if (tick.index() != index)
        return fmt::format("it says that it is tick {}", tick.index());
    if (tick.digests() == nullptr || tick.weather() == nullptr || !vectors_are_sound(tick) ||
        !structs_present(tick))
        return "a part of the tick is missing or misplaced";
    const world::TickView view{&tick, nullptr};
    if (!sorted(view))
        return "ids are out of order";
    if (!known_enumerators(tick))
        return "unknown kind of command, event or signal";
    for (const world::VehicleState& vehicle : view.vehicles()) {
        if (vehicle.model() >= world::vehicle_models().size())
            return fmt::format("unknown model {} of vehicle {}", vehicle.model(), vehicle.id());
    }
    for (const world::PropState& prop : view.props()) {
        if (prop.model() >= world::prop_models().size())
            return fmt::format("unknown model {} of prop {}", prop.model(), prop.id());
    }
    return std::nullopt;
}

std::optional<std::string> fault_of_command(mcap::View bytes) {
    auto check = verifier(bytes);
    if (!check.VerifyBuffer<world::Command>(nullptr))
        return "not a Command";
    const auto& command = *flatbuffers::GetRoot<world::Command>(bytes.data());
    if (!structs_present(command))
        return "a part of the command is missing";
    if (!known_enumerators(command))
        return "unknown kind of command";
    return std::nullopt;
}

/// A tick of which the trace holds inputs only: nothing in it that was not looked at.
std::optional<std::string> fault_of_inputs(mcap::View bytes, std::uint64_t index) {
    auto check = verifier(bytes);
    if (!world::VerifyTickBuffer(check))
        return "not a Tick";
    const world::Tick& tick = *world::GetTick(bytes.data());
    if (tick.index() != index)
        return fmt::format("it says that it is tick {}", tick.index());
    if (tick.digests() == nullptr || (tick.controls() != nullptr && !is_aligned(tick.controls())))
        return "a part of the tick is missing or misplaced";
    if (tick.weather() != nullptr || tick.commands() != nullptr || tick.vehicles() != nullptr ||
        tick.wheels() != nullptr || tick.signals() != nullptr || tick.measurements() != nullptr ||
        tick.events() != nullptr || tick.looks() != nullptr || tick.props() != nullptr ||
        tick.doors() != nullptr)
        return "it holds more than inputs";
    if (!ascending(world::TickView{&tick, nullptr}.controls(), actor_of))
        return "ids are out of order";
    return std::nullopt;
}

std::optional<std::string> fault_of_traffic(mcap::View bytes, std::uint64_t index) {
    auto check = verifier(bytes);
    if (!world::VerifyTrafficBuffer(check))
        return "not a Traffic";
    const world::Traffic& traffic = *world::GetTraffic(bytes.data());
    if (traffic.tick() != index)
        return fmt::format("its traffic says that it is of tick {}", traffic.tick());
    if (!is_aligned(traffic.cars()) || !is_aligned(traffic.walkers()) ||
        !is_aligned(traffic.looks()))
        return "a part of the traffic is missing or misplaced";
    const world::TickView view{nullptr, &traffic};
    if (!ascending(view.cars(), id_of) || !ascending(view.walkers(), id_of) ||
        !ascending(view.car_looks(), actor_of))
        return "ids of the traffic are out of order";
    for (const world::CarState& car : view.cars()) {
        if (car.model() >= world::vehicle_models().size())
            return fmt::format("unknown model {} of car {}", car.model(), car.id());
    }
    for (const world::WalkerState& walker : view.walkers()) {
        if (walker.model() >= world::walker_models().size())
            return fmt::format("unknown model {} of walker {}", walker.model(), walker.id());
    }
    return std::nullopt;
}

std::optional<std::string> fault_of_episode(mcap::View bytes) {
    auto check = verifier(bytes);
    if (!world::VerifyEpisodeBuffer(check))
        return "not an Episode";
    if (world::GetEpisode(bytes.data())->step_ns() == 0)
        return "an episode whose step is zero";
    std::uint64_t last = 0;
    const auto* branches = world::GetEpisode(bytes.data())->branches();
    if (branches == nullptr)
        return "an episode without its list of branches";
    for (flatbuffers::uoffset_t i = 0; i < branches->size(); ++i) {
        if (branches->Get(i)->tick() <= last)
            return "an episode whose branches are out of order";
        last = branches->Get(i)->tick();
    }
    return std::nullopt;
}

}  // namespace reprise::replay

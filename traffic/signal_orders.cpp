#include "traffic/signal_orders.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <libsumo/libsumo.h>

#include "world/check.h"

namespace reprise::traffic {

using libsumo::TrafficLight;
using world::SignalColor;

namespace {

/// The program's logic as SUMO counts it on, whether it is shown or not.
libsumo::TraCILogic logic_of(const std::string& light, const std::string& program) {
    for (const libsumo::TraCILogic& logic : TrafficLight::getAllProgramLogics(light))
        if (logic.programID == program)
            return logic;
    REPRISE_CHECK(false, "traffic light " + light + " lost its program " + program);
    return {};
}

/// Green as SUMO spells it: who always has to give way to others under this program does so under
/// an ordered green, too.
char green(const libsumo::TraCILogic& logic, std::size_t link) {
    const bool has_priority =
        std::any_of(logic.phases.begin(), logic.phases.end(), [&](const auto& phase) {
            return link < phase->state.size() && phase->state[link] == 'G';
        });
    return has_priority ? 'G' : 'g';
}

char spelling(SignalColor color, const libsumo::TraCILogic& logic, std::size_t link) {
    switch (color) {
        case SignalColor::red:
            return 'r';
        case SignalColor::red_yellow:
            return 'u';
        case SignalColor::yellow:
            return 'y';
        default:
            return green(logic, link);
    }
}

}  // namespace

void SignalOrders::give(const world::CommandT& command, std::uint64_t step_ns, std::uint64_t tick) {
    const double ticks = std::ceil(command.duration * 1e9 / static_cast<double>(step_ns) - 1e-6);
    const std::uint64_t until = command.duration > 0 ? tick + static_cast<std::uint64_t>(ticks)
                                                     : std::numeric_limits<std::uint64_t>::max();
    for (const std::uint32_t signal : command.signals) {
        const std::string& light = town_->signals.at(signal).program;
        const auto [found, is_new] = held_.try_emplace(light);
        if (is_new)
            found->second.program = TrafficLight::getProgram(light);
        if (command.color == SignalColor::off)
            found->second.orders.erase(signal);
        else
            found->second.orders.insert_or_assign(signal, Order{command.color, until});
    }
}

std::string SignalOrders::wanted_state(const std::string& light, const Held& held) const {
    const libsumo::TraCILogic logic = logic_of(light, held.program);
    std::string state = logic.phases.at(static_cast<std::size_t>(logic.currentPhaseIndex))->state;
    for (const auto& [signal, order] : held.orders) {
        const std::size_t link = town_->signals[signal].index;
        if (link < state.size())
            state[link] = spelling(order.color, logic, link);
    }
    return state;
}

void SignalOrders::follow(std::uint64_t tick) {
    for (auto at = held_.begin(); at != held_.end();) {
        auto& [light, held] = *at;
        std::erase_if(held.orders, [&](const auto& order) { return order.second.until <= tick; });
        if (held.orders.empty()) {
            TrafficLight::setProgram(light, held.program);
            at = held_.erase(at);
            continue;
        }
        std::string state = wanted_state(light, held);
        if (state != held.shown) {
            TrafficLight::setRedYellowGreenState(light, state);
            held.shown = std::move(state);
        }
        ++at;
    }
}

void SignalOrders::add_to(world::Hasher& hasher) const {
    for (const auto& [light, held] : held_) {
        hasher.add_text(light);
        hasher.add_text(held.shown);
        for (const auto& [signal, order] : held.orders) {
            hasher.add(std::uint64_t{signal});
            hasher.add(order.color);
            hasher.add(order.until);
        }
    }
}

}  // namespace reprise::traffic

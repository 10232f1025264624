#include "traffic/signal_programs.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include <libsumo/libsumo.h>

namespace reprise::traffic {

using world::SignalColor;

namespace {

SignalColor color_of(char state) {
    switch (state) {
        case 'r':
            return SignalColor::red;
        case 'u':
            return SignalColor::red_yellow;
        case 'y':
        case 'Y':
            return SignalColor::yellow;
        case 'G':
            return SignalColor::green;
        case 'g':
            return SignalColor::green_minor;
        case 's':
            return SignalColor::stop;
        default:
            return SignalColor::off;  // o: blinking yellow, O: off
    }
}

}  // namespace

SignalPrograms::SignalPrograms(const world::TownT& town)
    : town_(&town),
      colors_(town.signals.size(), SignalColor::off) {
    const std::vector<std::string> known = libsumo::TrafficLight::getIDList();
    for (std::size_t i = 0; i < town.signals.size(); ++i) {
        const std::string& name = town.signals[i].program;
        if (std::find(known.begin(), known.end(), name) == known.end())
            continue;
        if (programs_.empty() || programs_.back().name != name)
            programs_.push_back({name, i, 0, ""});
        ++programs_.back().count;
    }
}

void SignalPrograms::read(world::TickDraft& next) {
    for (Program& program : programs_) {
        std::string state = libsumo::TrafficLight::getRedYellowGreenState(program.name);
        if (state == program.state)
            continue;
        program.state = std::move(state);
        for (std::size_t i = program.first; i < program.first + program.count; ++i) {
            const std::uint32_t index = town_->signals[i].index;
            colors_[i] =
                index < program.state.size() ? color_of(program.state[index]) : SignalColor::off;
        }
    }
    next.tick.signals = colors_;
}

void SignalPrograms::add_to(world::Hasher& hasher) const {
    hasher.add(std::span<const SignalColor>(colors_));
    for (const Program& program : programs_)
        hasher.add_text(program.state);
}

}  // namespace reprise::traffic

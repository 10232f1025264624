#include "walkers/walker_lights.h"

#include <algorithm>

namespace reprise::walkers {

namespace {

constexpr std::uint32_t last_moment = 30;  // ticks of green in which nobody starts any more

constexpr std::uint32_t long_green = 2400;  // ticks

bool is_green(world::SignalColor color) {
    return color == world::SignalColor::green || color == world::SignalColor::green_minor;
}

}  // namespace

WalkerLights::WalkerLights(const world::TownT& town) {
    for (std::uint32_t i = 0; i < town.signals.size(); ++i)
        if (town.signals[i].for_walkers)
            lights_.push_back({i, town.signals[i].lane});
}

void WalkerLights::look(const world::TickView& last) {
    const std::span<const world::SignalColor> colors = last.signals();
    for (Light& light : lights_) {
        const bool green = light.signal < colors.size() && is_green(colors[light.signal]);
        if (light.green && !green)
            light.usual = light.age;
        light.age = green ? (light.green ? light.age + 1 : 1) : 0;
        light.green = green;
    }
}

std::vector<std::uint32_t> WalkerLights::of_crossing(std::uint32_t lane) const {
    std::vector<std::uint32_t> signals;
    for (const Light& light : lights_)
        if (light.crossing == lane)
            signals.push_back(light.signal);
    return signals;
}

bool WalkerLights::is_open(std::uint32_t signal) const {
    const auto light = std::lower_bound(
        lights_.begin(), lights_.end(), signal, [](const Light& one, std::uint32_t wanted) {
            return one.signal < wanted;
        });
    if (light == lights_.end() || light->signal != signal || !light->green)
        return false;
    if (light->usual == 0)  // nobody knows yet: at its start, or where it is always green
        return light->age <= 2 * last_moment || light->age > long_green;
    return light->usual <= 2 * last_moment || light->age + last_moment <= light->usual;
}

void WalkerLights::add_to(world::Hasher& hasher) const {
    for (const Light& light : lights_) {
        hasher.add(light.age);
        hasher.add(light.usual);
    }
}

}  // namespace reprise::walkers

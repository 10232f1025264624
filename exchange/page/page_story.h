// Private to the room.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "world/tick.h"

namespace reprise::exchange {

/// What happened in a run, tick by tick, in words: events, checks, weather, signals, and who is
/// called what.
class PageStory {
  public:
    /// `all_named`: the background's actors are worth their events, too, as in imported traces.
    explicit PageStory(bool all_named) : all_named_(all_named) {}

    /// Who is called what, of a tick that is not shown.
    void learn(const world::Tick& tick);

    /// The next tick that is shown.
    void hear(const world::Tick& tick);

    /// Adds names, drivers, events, weathers and signals.
    void write(nlohmann::json& head) const;

  private:
    /// From one tick to another; most begin and end in one.
    struct Happening {
        std::uint64_t tick = 0;
        std::uint64_t end = 0;
        world::EventKind kind{};
        std::uint32_t actor = 0;
        std::uint32_t other = 0;
        double value = 0;  ///< collision: the largest impulse [N s]
        world::Vec3 position;
        bool located = false;
        std::uint32_t line = 0;
        std::string text;
        std::string worst;  ///< of a failed check: how bad it became
    };

    void hear_event(const world::Event& event, std::uint64_t tick);
    bool hear_worst(const world::Event& event);
    bool goes_on(const world::Event& event, std::uint64_t tick);
    bool hear_end_of_collision(const world::Event& event, std::uint64_t tick);
    bool is_worth_telling(const world::Event& event) const;
    void hear_weather(const world::Tick& tick);
    void hear_signals(const world::Tick& tick);
    std::string name_of(std::uint32_t actor) const;
    std::string text_of(const Happening& happening) const;

    bool all_named_;
    std::map<std::uint32_t, std::string> names_;
    std::map<std::uint32_t, world::Driver> drivers_;
    std::vector<Happening> happenings_;
    /// By who hits whom: index of the last of their collisions.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> collisions_;
    nlohmann::json weathers_ = nlohmann::json::array();
    std::string weather_name_;
    std::vector<world::SignalColor> colours_;  ///< as of the last tick
    nlohmann::json signals_ = nlohmann::json::array();
};

}  // namespace reprise::exchange

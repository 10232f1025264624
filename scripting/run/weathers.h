#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "world/common_generated.h"
#include "world/digest.h"
#include "world/tick.h"

struct lua_State;

namespace reprise::scripting {

/// A weather as a scenario says it: its numbers, and what it does to the tyres' grip.
struct SaidWeather {
    world::Weather weather;
    double friction = 1;          ///< factor on dry asphalt's grip
    bool names_friction = false;  ///< in so many words, not as a part of a preset
    std::string name;             ///< for people: "clear_noon", "clear_noon, changed"
};

/// An entry of a timeline: from `at` on the weather changes evenly over `over`. [s]
struct WeatherEntry {
    double at = 0;
    double over = 0;
    SaidWeather said;
    std::uint32_t line = 0;
};

/// The value at the top of the stack: a preset's name (or a text as of `--weather`), or a table {
/// preset =, rain_mm_h =, ... }. What it does not name is as in `before`. Throws world::Error.
SaidWeather weather_at_top(lua_State* L, const std::string& who, const SaidWeather& before);

/// The same, with the keys `at` and `over` beside: an entry of a timeline.
WeatherEntry weather_entry_at_top(lua_State* L, const std::string& who, const SaidWeather& before);

/// A factor on the tyres' grip: in (0, 2], or throws.
double check_friction(const std::string& who, double friction);

/// A preset by its name, or what else world::read_weather takes, or throws.
SaidWeather preset_weather(const std::string& who, const std::string& text);

/// The weather's course in a run: what the header's timeline and set_weather asked for. Says a
/// command set_weather in every tick in which it changes.
class Weathers {
  public:
    /// `fixed_friction`: of the header; then weathers no longer change the grip unless they name
    /// it.
    void plan(std::vector<WeatherEntry> timeline, std::optional<double> fixed_friction);

    /// From the weather of the last tick to this one, as the command of this tick begins it; takes
    /// the place of a change that goes on.
    void change(const WeatherEntry& to,
                const world::TickView& last,
                std::uint64_t step_ns,
                world::CommandT& command);

    /// Begins what the timeline says for this time, and adds the command of this tick, if any.
    void advance(const world::TickView& last, world::TickDraft& next, std::uint64_t step_ns);

    void digest(world::Hasher& hasher) const;

  private:
    void begin(const WeatherEntry& to, const world::TickView& last, std::uint64_t step_ns);
    void fill(world::CommandT& command, const world::TickView& last);

    struct Change {
        world::Weather from;
        double friction_from = 1;
        SaidWeather to;
        std::uint64_t start = 0;  ///< the last tick before it
        std::uint64_t ticks = 0;  ///< at least 1
        std::uint32_t line = 0;
    };

    std::vector<WeatherEntry> timeline_;  ///< by `at`
    std::size_t next_entry_ = 0;
    std::optional<double> fixed_friction_;
    std::optional<Change> change_;
};

}  // namespace reprise::scripting

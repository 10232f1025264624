#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "world/tick.h"

namespace reprise::world {

/// Who is who in a run, as the ticks tell it that were heard.
class ActorNames {
  public:
    void hear(const TickView& tick);

    /// Of who was there before the first tick that is heard.
    void know(std::uint32_t id, const std::string& name);

    /// "ego"; of the demand "a passing hatchback (1000012)"; of id 0 "something fixed".
    std::string name_of(std::uint32_t id) const;

    /// The name that the scenario gave it; null where it gave none.
    const std::string* given(std::uint32_t id) const;

  private:
    struct Named {
        std::string text;  ///< a name, or of the demand a model
        bool is_name = false;
    };

    std::map<std::uint32_t, Named> named_;
};

/// A contact of two, as `collision` and `collision_ended` tell it.
struct Crash {
    std::uint32_t actor = 0;  ///< of the event
    std::uint32_t other = 0;
    std::string who;  ///< who came closer faster
    std::string whom;
    std::uint64_t tick = 0;       ///< of its `collision`
    std::optional<double> speed;  ///< [m/s] of one seen from the other in the tick before
    double impulse = 0;           ///< [N s] worst of a tick; 0: not recorded
    double duration = 0;          ///< [s]; 0: it has not ended
};

/// "ego hits sedan_2 at 8.4 m/s: 12,300 N s, in contact for 0.85 s"
std::string to_line(const Crash& crash);

/// Makes crashes of ticks that are heard one after the other. Costs 1 us a tick with 100 cars.
class CrashStory {
  public:
    /// Those that ended in this tick, in the order of their events.
    std::vector<Crash> hear(const TickView& tick);

    /// Those that have begun and not ended.
    const std::vector<Crash>& open() const { return open_; }

    const ActorNames& names() const { return names_; }

    ActorNames& names() { return names_; }

  private:
    Crash begun(const Event& event, std::uint64_t tick) const;

    ActorNames names_;
    std::vector<Crash> open_;
    std::uint64_t last_tick_ = 0;  ///< whose states these are
    std::vector<VehicleState> vehicles_;
    std::vector<CarState> cars_;
    std::vector<WalkerState> walkers_;
};

}  // namespace reprise::world

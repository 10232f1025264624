#pragma once

#include <string>
#include <vector>

#include "scripting/scenario.h"
#include "tests/support/worlds.h"
#include "world/tick.h"

namespace reprise::test {

/// A scenario whose run function has this body, in "test.lua". The body starts in line 1.
std::string running(const std::string& body);

/// Plays the kernel for a scenario: what it spawns stands in the next tick, standing still or
/// rolling ahead with its speed along its lane; walkers and cars alike.
class Stage {
  public:
    explicit Stage(const std::string& source, world::TownT town = straight_road(400, 2));

    /// One tick; the draft that the scenario wrote.
    const world::TickDraft& step();

    /// Steps until it said finish, or as many; what it printed, in order.
    std::vector<std::string> play(int ticks);

    void conclude();

    /// Put into the next tick as if physics had said so.
    void collide(std::uint32_t actor, std::uint32_t other);
    void remove(std::uint32_t actor);

    /// From the next tick on it is measured to have stood for so many ticks.
    void halt(std::uint32_t actor, std::uint64_t ticks);

    bool finished() const;
    std::string reason() const;
    std::vector<world::CommandT> commands;  ///< all so far
    std::vector<world::EventT> events;      ///< all of the scenario's so far
    std::vector<std::uint64_t> digests;     ///< one a tick
    world::EpisodeT episode;
    world::TownT town;
    world::LaneMap lanes;
    scripting::Scenario scenario;

  private:
    struct Body {
        std::uint32_t id;
        world::Driver driver;
        std::uint16_t model;
        std::uint32_t lane;
        double s;
        double offset;
        double speed;
    };

    void obey(const world::CommandT& command);
    void place(world::TickDraft& draft) const;
    void measure(const Body& body, world::TickDraft& draft) const;

    std::vector<Body> bodies_;
    std::vector<world::EventT> collisions_;
    std::vector<world::Measurement> measurements_;
    world::TickDraft draft_;
    world::SealedTick last_;
};

/// The message of the world::Error that playing this run function ends with; "" when it does not.
std::string mistake(const std::string& body);

/// As above, of a whole file.
std::string mistake_in_file(const std::string& source);

/// What the run function prints in up to 40 ticks.
std::vector<std::string> printed(const std::string& body);

}  // namespace reprise::test

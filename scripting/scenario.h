#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "world/check_result.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::scripting {

/// What the command line may change about a scenario.
struct Overrides {
    std::optional<std::string> town;  ///< a name, or the path of a network file
    std::optional<std::uint64_t> seed;
    std::optional<double> duration;                               ///< [s] the run's limit
    std::vector<std::pair<std::string, std::string>> parameters;  ///< --set key=value
    std::optional<std::string> weather{};    ///< a preset, with its road friction
    std::optional<double> friction{};        ///< of the road, as a factor on dry asphalt's grip
    std::optional<std::uint32_t> cars{};     ///< of the background traffic, or world::auto_cars
    std::optional<std::uint32_t> walkers{};  ///< in the background
};

/// Runs the scenario file's header (not yet its `run` function) and returns all that the run starts
/// from. `Episode.town` is as the scenario or the override names it: the caller finds the network.
/// `Episode.cars` may be world::auto_cars: once the town is known, world::settle_cars.
/// Throws world::Error, "cut_in.lua:12: ...", for a file that cannot be read, does not compile,
/// or holds an unknown key, model, weather or parameter.
world::EpisodeT load_episode(const std::filesystem::path& scenario_lua, const Overrides& overrides);

/// The same of a text that is in no file; `name` is what messages call it, such as my.lua.
world::EpisodeT episode_of_text(const std::string& name,
                                const std::string& source,
                                const Overrides& overrides);

/// What takes over in a branch of that run at that tick. `overrides` may hold parameters, and a
/// duration from the tick on; without one, and when the script names none, the run's own limit
/// stays. Throws world::Error as above, and for a script that wants another town, seed, cars or
/// weather: the world goes on as it is.
world::BranchT load_branch(const std::filesystem::path& scenario_lua,
                           const Overrides& overrides,
                           const world::EpisodeT& run,
                           std::uint64_t tick);

/// The script that runs at that tick goes on, and finds other parameters from there: those of
/// `overrides`. Throws world::Error for one that the script does not have.
world::BranchT change_branch(const Overrides& overrides,
                             const world::EpisodeT& run,
                             std::uint64_t tick);

/// A running scenario: one Lua machine in a sandbox, coroutine tasks resumed once a tick.
/// Everything it knows of the world is the last tick; everything it says is a Command.
class Scenario {
  public:
    /// Prepares `run`; `episode`, `town` and the town's `lanes` must outlive the scenario.
    Scenario(const world::EpisodeT& episode, const world::TownT& town, const world::LaneMap& lanes);
    ~Scenario();
    Scenario(const Scenario&) = delete;
    Scenario& operator=(const Scenario&) = delete;

    /// Stage 1. Resumes every task that is due, in the order of their start; evaluates the checks;
    /// appends to next.tick.commands (in the order said) and next.tick.events (printed lines,
    /// checks that failed). After a finish command it does nothing more. Throws world::Error,
    /// "cut_in.lua:12: ...", when the script fails.
    void advance(const world::TickView& last, world::TickDraft& next);

    /// The episode holds another script by now, which begins in the next step. It knows the actors
    /// there are (word: actor) and draws on from the streams; the old one's tasks end. Of its
    /// checks those that were decided stay, the others end with it.
    void take_over();

    /// Puts values into the table that `run` was called with: the script goes on where it is and
    /// finds them the next time it looks.
    void change(const std::vector<world::ParameterT>& parameters);

    /// Of instruction count, memory, actors, task and check states, draw counts. The script's own
    /// variables are not read: a script that holds other values either goes another way, which
    /// shows in its instructions and requests for memory, or says other things, which shows in
    /// the commands.
    std::uint64_t digest() const;

    /// As they stand; final once the run ended (call `conclude` first).
    std::vector<world::CheckResult> checks() const;

    /// Looks at every open check once more, in the last draft as it will be recorded, and settles
    /// all: appends their events (passed, failed, not evaluated) to it. Called once by the kernel
    /// in the run's last tick.
    void conclude(const world::TickView& last, world::TickDraft& next);

  private:
    struct Machine;
    std::unique_ptr<Machine> machine_;
};

}  // namespace reprise::scripting

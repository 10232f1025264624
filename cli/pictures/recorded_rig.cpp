#include "cli/pictures/recorded_rig.h"

#include "world/spawns.h"

namespace reprise::cli {

namespace {

/// Of the first that carries anything; of `actor`, where it is not 0, whatever that one carries.
class Search {
  public:
    explicit Search(std::uint32_t actor) : actor_(actor) {}

    /// Whether it is over.
    template <typename Command>
    bool look_at(const Command& spawn, std::uint32_t actor, std::uint64_t tick) {
        if (actor_ != 0 && actor != actor_)
            return false;
        found_ = world::rig_of(spawn, tick);
        return actor_ != 0 || !found_.sensors.empty();
    }

    std::optional<world::Rig> found() const {
        return found_.sensors.empty() ? std::nullopt : std::optional(found_);
    }

  private:
    std::uint32_t actor_;
    world::Rig found_;
};

}  // namespace

std::optional<world::Rig> recorded_rig(replay::TraceReader& trace,
                                       std::uint32_t actor,
                                       std::uint64_t last) {
    Search search(actor);
    if (const auto slice = trace.slice())
        for (const auto& [id, spawn] : slice->spawns)
            if (search.look_at(spawn.command, id, spawn.tick))
                return search.found();
    for (std::uint64_t index = trace.first(); index <= last; ++index)
        for (const world::Command* command : *trace.tick(index).view.tick->commands())
            if (command->kind() == world::CommandKind::spawn &&
                search.look_at(*command, command->actor(), index))
                return search.found();
    return std::nullopt;
}

}  // namespace reprise::cli

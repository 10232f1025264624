#include "replay/table/actor_search.h"

#include <charconv>
#include <optional>

#include <fmt/format.h>

#include "replay/table/kept.h"
#include "world/check.h"

namespace reprise::replay {

namespace {

std::optional<std::uint32_t> id_in(const std::string& text) {
    std::uint32_t id = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, id);
    if (error != std::errc() || stop != end)
        return std::nullopt;
    return id;
}

bool is_there(const world::TickView& view, std::uint32_t id) {
    return world::find(view.vehicles(), id) != nullptr ||
           (view.traffic != nullptr && (world::find(view.cars(), id) != nullptr ||
                                        world::find(view.walkers(), id) != nullptr));
}

}  // namespace

std::uint32_t find_actor(TraceReader& trace, const std::string& name_or_id) {
    require_kept(trace, "vehicles");
    const std::optional<std::uint32_t> id = id_in(name_or_id);
    std::vector<std::string> names;
    if (const auto slice = trace.slice())
        for (const auto& [actor, spawn] : slice->spawns) {
            if (spawn.command.text == name_or_id)
                return actor;
            names.push_back(spawn.command.text);
        }
    for (std::uint64_t index = trace.first(); index <= trace.last(); ++index) {
        const world::TickView view = trace.recorded(index).view;
        if (id && is_there(view, *id))
            return *id;
        for (const world::Event* event : *view.tick->events()) {
            // The events of background cars carry their model, not a name.
            if (event->kind() != world::EventKind::spawned || event->text() == nullptr ||
                event->actor() >= world::first_background_id)
                continue;
            if (event->text()->string_view() == name_or_id || (id && event->actor() == *id))
                return event->actor();
            names.push_back(event->text()->str());
        }
    }
    std::string suggestion = world::did_you_mean(name_or_id, names);
    if (suggestion.empty() && !names.empty())
        suggestion = fmt::format("; the scenario's are {}", fmt::join(names, ", "));
    throw world::Error(
        fmt::format("{}: no actor '{}'{}", trace.path().string(), name_or_id, suggestion));
}

}  // namespace reprise::replay

// What was going on when two runs parted: who it was, what the scenario had said, whose builds.
#include <algorithm>

#include <fmt/format.h>

#include "replay/compare/divergence.h"

namespace reprise::replay {

namespace {

bool is_there(std::uint32_t actor, const world::TickView& tick) {
    return world::find(tick.vehicles(), actor) != nullptr ||
           world::find(tick.cars(), actor) != nullptr ||
           world::find(tick.walkers(), actor) != nullptr;
}

/// The first tick in which an actor stands that stands in tick `until`: ids are never reused, so a
/// binary search finds it. Damaged ticks are passed over.
std::uint64_t spawn_tick(std::uint32_t actor, TraceReader& trace, std::uint64_t until) {
    std::uint64_t low = 0;  // not there yet
    std::uint64_t high = until;
    while (high - low > 1) {
        const std::uint64_t middle = low + (high - low) / 2;
        const bool there = !trace.damage(middle) && is_there(actor, trace.recorded(middle).view);
        (there ? high : low) = middle;
    }
    return high;
}

/// "ego (1)", from the run's spawned events up to that tick; "actor 1" when there is no name.
std::string name_of(std::uint32_t actor, TraceReader& trace, std::uint64_t until) {
    const std::string number = fmt::format("actor {}", actor);
    if (actor >= world::first_background_id || trace.level() == Level::inputs)
        return number;  // nobody named those, or not in this trace
    // Most stand in the first ticks. Where one does not (any more) the search ends nowhere.
    constexpr std::uint64_t first_ticks = 64;
    const std::uint64_t spawned = spawn_tick(actor, trace, until);
    const std::uint64_t early = std::min(first_ticks, until);
    for (std::uint64_t index = 1; index <= early + 1; ++index) {
        const std::uint64_t tick = index <= early ? index : spawned;
        if (trace.damage(tick))
            continue;
        for (const world::Event* event : *trace.recorded(tick).view.tick->events())
            if (event->kind() == world::EventKind::spawned && event->actor() == actor &&
                event->text() != nullptr)
                return fmt::format("{} ({})", event->text()->string_view(), actor);
    }
    return number;
}

/// What a line of the scenario did last in a tick.
struct Said {
    std::string what;
    std::uint32_t actor = 0;
    std::uint32_t line = 0;
};

std::optional<Said> last_said(const world::Tick& tick) {
    std::optional<Said> said;
    for (const world::Event* event : *tick.events())
        if (event->line() != 0)
            said = Said{world::EnumNameEventKind(event->kind()), event->actor(), event->line()};
    // Commands are what changes the run; most events with a line only follow from one.
    for (const world::Command* command : *tick.commands())
        if (command->line() != 0)
            said = Said{
                world::EnumNameCommandKind(command->kind()), command->actor(), command->line()};
    return said;
}

std::string script_before(const Divergence& divergence, TraceReader& trace) {
    // A command or an event that differs is not before itself.
    const bool itself =
        divergence.field.starts_with("commands") || divergence.field.starts_with("events");
    const std::uint64_t from = std::min(divergence.tick - (itself ? 1 : 0), trace.ticks());
    const std::uint64_t to = from > longest_search ? from - longest_search : 0;
    for (std::uint64_t index = from; index > to; --index) {
        if (trace.damage(index))
            continue;
        const auto said = last_said(*trace.recorded(index).view.tick);
        if (!said)
            continue;
        return fmt::format("tick {} ({:.2f} s): {}{}, {}:{}",
                           index,
                           world::seconds(index, trace.episode().step_ns),
                           said->what,
                           said->actor == 0 ? "" : " of " + name_of(said->actor, trace, index),
                           trace.episode().scenario_path,
                           said->line);
    }
    return to == 0 ? "" : fmt::format("said nothing in the {} ticks before", longest_search);
}

}  // namespace

void add_context(Divergence& divergence, TraceReader& trace) {
    if (divergence.tick == 0)
        return;
    if (divergence.actor_id != 0)
        divergence.actor =
            name_of(divergence.actor_id, trace, std::min(divergence.tick, trace.ticks()));
    if (trace.level() != Level::inputs)
        divergence.script = script_before(divergence, trace);
}

void add_first_recorded(Divergence& divergence,
                        const std::optional<Divergence>& recorded,
                        std::uint64_t searched) {
    if (recorded)
        divergence.note += fmt::format("; in the record it first shows at tick {}, stage {}: {}",
                                       recorded->tick,
                                       recorded->stage,
                                       recorded->field);
    else if (searched > 0)
        divergence.note +=
            fmt::format("; nothing in the record shows it in the next {} ticks", searched);
}

std::vector<BuildDifference> build_differences(const Fingerprint& expected,
                                               const Fingerprint& found) {
    const auto value = [](const Fingerprint& lines, const std::string& key) {
        const auto line = std::find_if(
            lines.begin(), lines.end(), [&](const world::ParameterT& l) { return l.key == key; });
        return line == lines.end() ? std::string("-") : line->value;
    };
    std::vector<BuildDifference> differences;
    for (const Fingerprint* lines : {&expected, &found})
        for (const world::ParameterT& line : *lines) {
            BuildDifference one{line.key, value(expected, line.key), value(found, line.key)};
            const bool known = std::any_of(differences.begin(),
                                           differences.end(),
                                           [&](const auto& other) { return other.key == one.key; });
            if (one.expected != one.found && !known)
                differences.push_back(std::move(one));
        }
    return differences;
}

}  // namespace reprise::replay

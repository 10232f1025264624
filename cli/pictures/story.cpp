#include "cli/pictures/story.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "world/town.h"

namespace reprise::cli {

namespace {

constexpr double stays = 3;  // [s] a line stays
constexpr std::size_t most_lines = 5;
constexpr double kmh = 3.6;

}  // namespace

Story::Story(replay::TraceReader& trace)
    : trace_(trace),
      read_(trace.first() - 1),
      moment_(static_cast<std::uint64_t>(
          std::llround(stays * 1e9 / static_cast<double>(trace.episode().step_ns)))) {}

void Story::read_to(std::uint64_t tick) {
    while (read_ < tick) {
        ++read_;
        for (const world::Event* event : *trace_.tick(read_).view.tick->events())
            hear(*event, read_);
    }
    while (!lines_.empty() && lines_.front().tick + moment_ < tick)
        lines_.pop_front();
}

std::string Story::name_of(std::uint32_t actor) const {
    for (const render::ActorNames* names : {&names_, &models_})
        if (const auto name = names->find(actor); name != names->end())
            return name->second;
    return fmt::format("actor {}", actor);
}

void Story::hear(const world::Event& event, std::uint64_t tick) {
    using enum world::EventKind;
    using render::Tone;
    const auto tell = [&](const std::string& text, Tone tone) {
        lines_.push_back({tick, {text, tone}});
    };
    const bool of_scenario = event.actor() != 0 && event.actor() < world::first_background_id;
    switch (event.kind()) {
        case spawned:
            (of_scenario ? names_ : models_)[event.actor()] = world::to_line(event);
            if (!of_scenario)
                return;
            return tell("spawned: " + world::to_line(event), Tone::plain);
        case collision:
            return hear_collision(event, tick);
        case printed:
            return tell(world::to_line(event), Tone::plain);
        case check_passed:
            return tell("check passed: " + world::to_line(event), Tone::good);
        case check_failed:
            if (!world::tells_worst(event))
                tell("check failed: " + world::to_line(event), Tone::bad);
            return;
        case not_evaluated:
            return tell("check not evaluated: " + world::to_line(event), Tone::plain);
        case blocked:
            return tell(name_of(event.actor()) + " " + world::to_line(event), Tone::bad);
        case backed_off:
            return tell(name_of(event.actor()) + " " + world::to_line(event), Tone::plain);
        case overtakes:
            return tell(fmt::format("{} overtakes {} {}",
                                    name_of(event.actor()),
                                    name_of(event.other()),
                                    world::to_line(event)),
                        Tone::plain);
        default:
            return;
    }
}

/// One crash is told in every tick in which it pushes: one line, with the strongest push.
void Story::hear_collision(const world::Event& event, std::uint64_t tick) {
    const std::uint32_t one = std::min(event.actor(), event.other());
    const std::uint32_t other = std::max(event.actor(), event.other());
    const auto known = std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) {
        return line.impulse > 0 && line.one == one && line.other == other;
    });
    Line line{tick, {}, one, other, std::max(event.value(), 1e-9)};
    if (known != lines_.end()) {
        line.impulse = std::max(line.impulse, known->impulse);
        lines_.erase(known);
    }
    line.line = {fmt::format("collision: {} with {}, {:.0f} N s",
                             name_of(event.actor()),
                             event.other() == 0 ? "something fixed" : name_of(event.other()),
                             line.impulse),
                 render::Tone::bad};
    lines_.push_back(line);
}

render::OverlayText Story::text(const world::TickView& tick, std::uint32_t actor, bool last) const {
    render::OverlayText text;
    text.clock.push_back({fmt::format("{:.2f} s  tick {}",
                                      world::seconds(tick.index(), trace_.episode().step_ns),
                                      tick.index())});
    if (const world::Measurement* own = world::find(tick.measurements(), actor)) {
        const std::vector<world::LaneT>& lanes = trace_.recording().town.lanes;
        const std::string lane =
            own->lane() < lanes.size() ? lanes[own->lane()].name : "off every lane";
        text.clock.push_back({fmt::format(
            "{} {} km/h  {}", name_of(actor), std::lround(std::abs(own->speed()) * kmh), lane)});
    }
    const std::size_t skipped = lines_.size() > most_lines ? lines_.size() - most_lines : 0;
    for (std::size_t i = skipped; i < lines_.size(); ++i)
        text.events.push_back(lines_[i].line);
    if (last) {
        const world::Outcome& outcome = trace_.outcome();
        const std::string& verdict = outcome.verdict;
        text.verdict = {verdict + (outcome.reason.empty() ? "" : ": " + outcome.reason),
                        verdict == "passed"                            ? render::Tone::good
                        : verdict == "completed" || verdict == "ended" ? render::Tone::plain
                                                                       : render::Tone::bad};
    }
    return text;
}

}  // namespace reprise::cli

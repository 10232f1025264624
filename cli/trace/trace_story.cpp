#include "cli/trace/trace_story.h"

#include <algorithm>

#include <fmt/format.h>

#include "replay/imported.h"
#include "world/tick.h"

namespace reprise::cli {

namespace {

constexpr std::uint64_t chunk = 64;  // ticks

class Teller {
  public:
    TraceStory story;

    /// Who was there before the first tick of a slice.
    void know(std::uint32_t id, const std::string& name) {
        story.actors.push_back({id, name});
        heard_.names().know(id, name);
    }

    void hear(const world::TickView& tick) {
        for (world::Crash& crash : heard_.hear(tick))
            add(std::move(crash));
        for (const world::Event* event : *tick.tick->events())
            hear(*event, tick.index());
    }

    /// Of contacts that never ended, such as those of an imported log, too.
    void end() {
        for (const world::Crash& crash : heard_.open())
            add(crash);
        std::stable_sort(
            story.crashes.begin(), story.crashes.end(), [](const auto& one, const auto& other) {
                return one.first < other.first;
            });
    }

  private:
    void hear(const world::Event& event, std::uint64_t tick) {
        switch (event.kind()) {
            case world::EventKind::spawned:
                if (event.actor() < world::first_background_id)
                    story.actors.push_back({event.actor(), world::to_line(event)});
                return;
            case world::EventKind::despawned:
            case world::EventKind::collision:  // a crash
            case world::EventKind::collision_ended:
            case world::EventKind::finished:  // the outcome says so
                return;
            case world::EventKind::check_passed:
                story.checks.push_back({"passed", world::to_line(event), tick});
                return;
            case world::EventKind::check_failed:
                hear_failure(event, tick);
                return;
            case world::EventKind::not_evaluated:
                story.checks.push_back({"not evaluated", world::to_line(event), tick});
                return;
            default:
                count(event, tick);
        }
    }

    void add(world::Crash crash) {
        auto same =
            std::find_if(story.crashes.begin(), story.crashes.end(), [&](const auto& known) {
                return known.worst.actor == crash.actor && known.worst.other == crash.other;
            });
        if (same == story.crashes.end())
            same = story.crashes.insert(same, {0, crash, crash.tick, crash.tick});
        ++same->count;
        same->first = std::min(same->first, crash.tick);
        same->last = std::max(same->last, crash.tick);
        if (crash.impulse > same->worst.impulse)
            same->worst = std::move(crash);
    }

    /// What tells how bad it became belongs to the failure, where that was read.
    void hear_failure(const world::Event& event, std::uint64_t tick) {
        if (world::tells_worst(event))
            for (std::size_t i = 0; i < failed_.size(); ++i)
                if (failed_[i].name == event.text()->str()) {
                    story.checks[failed_[i].index].worst = event.detail()->str();
                    return;
                }
        failed_.push_back({event.text()->str(), story.checks.size()});
        story.checks.push_back({"failed", world::to_line(event), tick});
    }

    void count(const world::Event& event, std::uint64_t tick) {
        const std::string name = world::EnumNameEventKind(event.kind());
        auto kind = std::find_if(story.kinds.begin(), story.kinds.end(), [&](const auto& known) {
            return known.name == name;
        });
        if (kind == story.kinds.end())
            kind = story.kinds.insert(kind, {name, 0, tick, tick, describe(event), ""});
        ++kind->count;
        kind->last = tick;
        kind->last_text = describe(event);
    }

    std::string describe(const world::Event& event) const {
        const bool is_infraction = event.kind() >= world::EventKind::ran_red_light &&
                                   event.kind() <= world::EventKind::wrong_way;
        const bool is_about_actor = event.kind() == world::EventKind::blocked ||
                                    event.kind() == world::EventKind::wrecked ||
                                    event.kind() == world::EventKind::backed_off || is_infraction;
        if (event.kind() == world::EventKind::overtakes)
            return fmt::format("{} overtakes {} {}",
                               heard_.names().name_of(event.actor()),
                               heard_.names().name_of(event.other()),
                               world::to_line(event));
        if (is_about_actor)
            return fmt::format(
                "{} {}", heard_.names().name_of(event.actor()), world::to_line(event));
        return world::to_line(event);
    }

    struct Failed {
        std::string name;
        std::size_t index = 0;  ///< in story.checks
    };

    std::vector<Failed> failed_;
    world::CrashStory heard_;
};

}  // namespace

TraceStory read_story(replay::TraceReader& trace, bool all) {
    Teller teller;
    if (const auto slice = trace.slice())
        for (const auto& [id, spawn] : slice->spawns)
            teller.know(id, spawn.command.text);
    const std::uint64_t ticks = trace.ticks();
    const std::uint64_t first = trace.first();
    teller.story.whole = all || ticks <= 2 * chunk;
    for (std::uint64_t index = first; index <= trace.last(); ++index) {
        if (!teller.story.whole && index == first + chunk)
            index = trace.last() - chunk + 1;
        const world::TickView tick = trace.recorded(index).view;
        if (tick.tick->events() == nullptr)  // the trace's level leaves them out
            break;
        teller.story.told.hear(*tick.tick);
        teller.hear(tick);
    }
    teller.end();
    const bool has_traffic = ticks > 0 && trace.level() == replay::Level::full;
    if (has_traffic) {
        const world::TickView last = trace.recorded(trace.last()).view;
        const bool imported = replay::is_imported(trace);  // all are foreign, then
        const auto of_demand = [&](const auto& actor) {
            return imported || actor.id() >= world::first_background_id;
        };
        const auto count = [&](const auto& range) {
            return static_cast<std::uint64_t>(std::count_if(range.begin(), range.end(), of_demand));
        };
        teller.story.cars = count(last.cars());
        teller.story.walkers = count(last.walkers());
    }
    return std::move(teller.story);
}

ChannelBytes sample_channels(replay::TraceReader& trace) {
    constexpr std::uint64_t most = 16;
    const std::uint64_t ticks = trace.ticks();
    const std::uint64_t samples = std::min(most, ticks);
    ChannelBytes bytes;
    for (std::uint64_t i = 0; i < samples; ++i) {
        const replay::RecordedTick tick = trace.recorded(trace.first() + i * ticks / samples);
        bytes.tick += tick.tick_bytes.size();
        bytes.traffic += tick.traffic_bytes.size();
    }
    if (samples > 0) {
        bytes.tick = bytes.tick * ticks / samples;
        bytes.traffic = bytes.traffic * ticks / samples;
    }
    return bytes;
}

}  // namespace reprise::cli

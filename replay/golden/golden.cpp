// From a trace to a golden.
//   must      say the same text for the same run on every CPU; stay small enough to be reviewed
//   assumes   that stage digests cover all that decides the future: see docs/determinism.md
//   goes      once through the ticks; digests are gathered between checkpoints, states at them
//   keeps     names of the actors that were spawned so far
#include "replay/golden/golden.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "replay/table/value.h"
#include "replay/table/value_text.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::replay {

namespace {

constexpr std::uint64_t most_checkpoints = 600;  ///< then they come less often
constexpr std::uint64_t most_states = 100;       ///< lines; likewise
constexpr std::size_t most_actors = 100;         ///< in full at an instant
constexpr std::size_t most_events = 100;         ///< in full; results of checks come on top
constexpr std::size_t longest_text = 200;        ///< [bytes] of an event

std::string hex32(const world::Hasher& hasher) {
    return fmt::format("{:08x}", hasher.digest64() & 0xffffffffu);
}

std::string hex64(std::string_view bytes) {
    world::Hasher hasher;
    hasher.add_text(bytes);
    return fmt::format("{:016x}", hasher.digest64());
}

using DigestOf = std::uint64_t (world::Digests::*)() const;

constexpr std::array<DigestOf, 5> stage_digests{&world::Digests::controls,
                                                &world::Digests::traffic,
                                                &world::Digests::pedestrians,
                                                &world::Digests::physics,
                                                &world::Digests::measurements};

std::string place_text(const world::Vec3& place) {
    return decimal(place.x()) + " " + decimal(place.y()) + " " + decimal(place.z());
}

/// As a golden's file can hold it. What is not UTF-8 keeps a digest of its bytes.
std::string readable(const std::string& text) {
    const std::string clean = valid_utf8(text);
    return clean == text ? text : fmt::format("{} ({})", clean, hex64(text));
}

std::string shortened(const std::string& text) {
    if (text.size() <= longest_text)
        return readable(text);
    std::size_t size = longest_text;
    while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0u) == 0x80u)
        --size;  // no half characters
    return fmt::format("{}... ({})", valid_utf8(text.substr(0, size)), hex64(text));
}

bool is_check(world::EventKind kind) {
    return kind == world::EventKind::check_passed || kind == world::EventKind::check_failed ||
           kind == world::EventKind::not_evaluated;
}

/// The demand's coming and going is in the traffic digests.
bool is_background(const world::Event& event) {
    return event.actor() >= world::first_background_id &&
           (event.kind() == world::EventKind::spawned ||
            event.kind() == world::EventKind::despawned);
}

GoldenCheck check_of(const world::Event& event, std::uint64_t tick) {
    GoldenCheck check;
    const bool failed = event.kind() == world::EventKind::check_failed;
    check.status = failed                                           ? "failed"
                   : event.kind() == world::EventKind::check_passed ? "passed"
                                                                    : "not_evaluated";
    check.tick = failed ? tick : 0;
    check.line = event.line();
    check.name = event.text() == nullptr ? "" : readable(event.text()->str());
    check.detail = event.detail() == nullptr ? "" : readable(event.detail()->str());
    return check;
}

/// Goes through a run once.
class Maker {
  public:
    Maker(TraceReader& trace, Golden& golden) : trace_(trace), golden_(golden) {}

    void make() {
        for (std::uint64_t index = 1; index <= trace_.ticks(); ++index) {
            const world::TickView tick = trace_.tick(index).view;
            read_events(tick);
            digest(*tick.tick->digests());
            if (is_due(index, golden_.sampling.checkpoints)) {
                add_checkpoint(index);
                add_background(tick);
            }
            if (is_due(index, golden_.sampling.states))
                add_states(tick);
        }
        fold_events();
        std::stable_sort(golden_.checks.begin(),
                         golden_.checks.end(),
                         [](const GoldenCheck& left, const GoldenCheck& right) {
                             return std::tie(left.line, left.name) <
                                    std::tie(right.line, right.name);
                         });
    }

  private:
    /// The first tick at or after every n-th second, and the run's last.
    bool is_due(std::uint64_t index, std::uint64_t seconds) const {
        const std::uint64_t every_ns = seconds * 1'000'000'000;
        return index == trace_.ticks() ||
               index * golden_.step_ns / every_ns != (index - 1) * golden_.step_ns / every_ns;
    }

    std::string label(std::uint32_t actor) const {
        if (actor == 0)
            return "";
        const auto name = names_.find(actor);
        return fmt::format("{}#{}", name == names_.end() ? "" : readable(name->second), actor);
    }

    void read_events(const world::TickView& tick) {
        for (const world::Event* event : *tick.tick->events()) {
            if (is_background(*event))
                continue;
            if (event->kind() == world::EventKind::spawned && event->text() != nullptr)
                names_[event->actor()] = event->text()->str();
            if (is_check(event->kind()))
                add_check(check_of(*event, tick.index()), world::tells_worst(*event));
            else
                golden_.events.push_back(event_of(*event, tick.index()));
        }
    }

    /// How bad a failed check became belongs to its failure.
    void add_check(GoldenCheck check, bool tells_worst) {
        const auto failed = std::find_if(
            golden_.checks.begin(), golden_.checks.end(), [&](const GoldenCheck& before) {
                return before.name == check.name && before.status == check.status;
            });
        if (tells_worst && failed != golden_.checks.end())
            failed->detail += "; " + check.detail;
        else
            golden_.checks.push_back(std::move(check));
    }

    GoldenEvent event_of(const world::Event& event, std::uint64_t tick) const {
        GoldenEvent out;
        out.tick = tick;
        out.kind = world::EnumNameEventKind(event.kind());
        out.actor = label(event.actor());
        out.other = label(event.other());
        if (event.kind() != world::EventKind::spawned && event.text() != nullptr)
            out.text = shortened(event.text()->str());
        out.line = event.line();
        if (event.value() != 0)
            out.value = decimal(event.value());
        if (event.position() != nullptr && (event.kind() == world::EventKind::collision ||
                                            event.kind() == world::EventKind::blocked))
            out.place = place_text(*event.position());
        return out;
    }

    /// A scenario that prints in every tick: the first ones in full, the rest as one line a second.
    void fold_events() {
        std::vector<GoldenEvent>& events = golden_.events;
        if (events.size() <= most_events)
            return;
        const std::vector<GoldenEvent> rest(events.begin() + most_events, events.end());
        events.resize(most_events);
        const auto second_of = [&](const GoldenEvent& event) {
            return event.tick * golden_.step_ns / 1'000'000'000;
        };
        for (auto next = rest.begin(); next != rest.end();) {
            const auto first = next;
            world::Hasher hasher;
            for (; next != rest.end() && second_of(*next) == second_of(*first); ++next)
                add(hasher, *next);
            GoldenEvent folded;
            folded.tick = first->tick;
            folded.kind = "more";
            folded.text = fmt::format("{} events, {}", next - first, hex32(hasher));
            events.push_back(std::move(folded));
        }
    }

    static void add(world::Hasher& hasher, const GoldenEvent& event) {
        hasher.add(event.tick);
        for (const std::string* part :
             {&event.kind, &event.actor, &event.other, &event.text, &event.value, &event.place})
            hasher.add_text(*part);
    }

    void digest(const world::Digests& digests) {
        // From nothing, not from Digests::chain: a comment in the scenario changes that one.
        world::Hasher all;
        for (std::size_t i = 0; i < stages_.size(); ++i) {
            const std::uint64_t stage = (digests.*stage_digests[i])();
            stages_[i].push_back(stage);
            all.add(stage);
        }
        history_ = world::chain(history_, all.digest128());
    }

    void add_checkpoint(std::uint64_t index) {
        Checkpoint checkpoint;
        checkpoint.tick = index;
        checkpoint.history = world::to_hex(history_).substr(0, 16);
        for (std::vector<std::uint64_t>& stage : stages_) {
            world::Hasher hasher;
            hasher.add(std::span<const std::uint64_t>(stage));
            checkpoint.stages.push_back(hex32(hasher));
            stage.clear();
        }
        golden_.checkpoints.push_back(std::move(checkpoint));
    }

    void add_background(const world::TickView& tick) {
        BackgroundState state;
        state.tick = tick.index();
        world::Hasher hasher;
        for (const world::CarState& car : tick.cars()) {
            if (car.id() < world::first_background_id)
                continue;
            ++state.cars;
            hasher.add(car);
        }
        for (const world::WalkerState& walker : tick.walkers()) {
            if (walker.id() < world::first_background_id)
                continue;
            ++state.walkers;
            hasher.add(walker);
        }
        if (state.cars + state.walkers == 0)
            return;
        state.digest = hex32(hasher);
        golden_.background.push_back(std::move(state));
    }

    void add_states(const world::TickView& tick) {
        std::map<std::uint32_t, ActorState> by_id;
        const auto add = [&](std::uint32_t id, std::initializer_list<std::string> values) {
            ActorState& state = by_id[id];
            state.tick = tick.index();
            state.actor = label(id);
            for (auto value = values.begin(); value != values.end(); value += 2)
                state.values.emplace_back(*value, *(value + 1));
        };
        for (const world::VehicleState& car : tick.vehicles()) {
            const world::Vec3& place = car.position();
            // The velocity shows the heading too; the yaw would take libm's atan2.
            add(car.id(),
                {"x",
                 decimal(place.x()),
                 "y",
                 decimal(place.y()),
                 "z",
                 decimal(place.z()),
                 "vx",
                 decimal(car.velocity().x()),
                 "vy",
                 decimal(car.velocity().y()),
                 "steering",
                 decimal(car.steering_angle())});
        }
        const auto add_place = [&](const auto& actor) {
            if (actor.id() >= world::first_background_id)
                return;
            const world::Vec3& place = actor.position();
            add(actor.id(),
                {"x",
                 decimal(place.x()),
                 "y",
                 decimal(place.y()),
                 "z",
                 decimal(place.z()),
                 "yaw",
                 decimal(actor.yaw()),
                 "speed",
                 decimal(actor.speed())});
        };
        std::for_each(tick.cars().begin(), tick.cars().end(), add_place);
        std::for_each(tick.walkers().begin(), tick.walkers().end(), add_place);
        std::size_t count = 0;
        for (auto& [id, state] : by_id)
            if (count++ < most_actors)
                golden_.states.push_back(std::move(state));
    }

    TraceReader& trace_;
    Golden& golden_;
    std::map<std::uint32_t, std::string> names_;
    std::array<std::vector<std::uint64_t>, stage_digests.size()> stages_;
    world::Digest128 history_{};
};

std::vector<std::pair<std::string, std::string>> starts_of(const world::EpisodeT& episode) {
    std::vector<std::pair<std::string, std::string>> starts{
        {"town", readable(episode.town) + " " + world::to_hex(episode.town_digest).substr(0, 16)},
        {"seed", std::to_string(episode.seed)},
        {"substeps", std::to_string(episode.substeps)},
        {"max_ticks", std::to_string(episode.max_ticks)},
        {"cars", std::to_string(episode.cars)},
        {"road_friction", decimal(episode.road_friction)},
        {"weather", readable(episode.weather_name)}};
    if (episode.walkers > 0) {
        starts.emplace_back("walkers", std::to_string(episode.walkers));
        starts.emplace_back("walker_seed", std::to_string(episode.walker_seed));
        starts.emplace_back("jaywalkers", decimal(episode.jaywalkers));
    }
    for (const world::ParameterT& parameter : episode.parameters)
        starts.emplace_back("set " + parameter.key, readable(parameter.value));
    return starts;
}

/// How many actors the scenario has at most at one instant, as far as a look once a second tells.
std::uint64_t count_actors(TraceReader& trace) {
    std::uint64_t most = 0;
    const std::uint64_t step_ns = std::max<std::uint64_t>(trace.episode().step_ns, 1);
    const std::uint64_t second = std::max<std::uint64_t>(1, 1'000'000'000 / step_ns);
    for (std::uint64_t index = second; index <= trace.ticks(); index += second) {
        const world::TickView tick = trace.tick(index).view;
        const auto of_scenario = [](const auto& actor) {
            return actor.id() < world::first_background_id;
        };
        const auto count = [&](const auto& actors) {
            return static_cast<std::uint64_t>(
                std::count_if(actors.begin(), actors.end(), of_scenario));
        };
        most = std::max(most, count(tick.vehicles()) + count(tick.cars()) + count(tick.walkers()));
    }
    return most;
}

std::uint64_t divided_up(std::uint64_t value, std::uint64_t by) {
    return (value + by - 1) / by;
}

Sampling choose_sampling(TraceReader& trace) {
    const std::uint64_t seconds =
        divided_up(trace.ticks() * trace.episode().step_ns, 1'000'000'000);
    Sampling sampling;
    sampling.checkpoints = std::max<std::uint64_t>(1, divided_up(seconds, most_checkpoints));
    const std::uint64_t states = divided_up(
        seconds * std::min<std::uint64_t>(count_actors(trace), most_actors), most_states);
    sampling.states = std::max(sampling.checkpoints, states);
    return sampling;
}

}  // namespace

bool GoldenEvent::same_story(const GoldenEvent& than) const {
    return std::tie(tick, kind, actor, other, text) ==
           std::tie(than.tick, than.kind, than.actor, than.other, than.text);
}

const std::vector<std::string>& golden_stages() {
    static const std::vector<std::string> names{
        "controls", "traffic", "pedestrians", "physics", "measurements"};
    return names;
}

Golden make_golden(TraceReader& trace, std::optional<Sampling> sampling) {
    const world::EpisodeT& episode = trace.episode();
    Golden golden;
    golden.scenario = readable(episode.scenario_path);
    golden.scenario_digest = hex64(episode.scenario);
    golden.build = episode.fingerprint;
    golden.starts = starts_of(episode);
    golden.chain = world::to_hex(trace.chain(trace.ticks()));
    golden.step_ns = episode.step_ns;
    golden.sampling = sampling ? *sampling : choose_sampling(trace);
    golden.verdict = trace.outcome().verdict;
    golden.reason = readable(trace.outcome().reason);
    golden.ticks = trace.ticks();
    Maker(trace, golden).make();
    return golden;
}

std::string time_text(std::uint64_t tick, std::uint64_t step_ns) {
    return fmt::format("{:.2f} s", world::seconds(tick, step_ns));
}

std::string golden_seconds(std::uint64_t tick, std::uint64_t step_ns) {
    const std::uint64_t ms = tick * step_ns / 1'000'000;
    std::string text = fmt::format("{}.{:03}", ms / 1000, ms % 1000);
    while (text.back() == '0')
        text.pop_back();
    if (text.back() == '.')
        text.pop_back();
    return text;
}

}  // namespace reprise::replay

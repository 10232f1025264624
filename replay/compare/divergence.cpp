#include "replay/compare/divergence.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "replay/compare/field_difference.h"
#include "replay/compare/tick_bytes.h"
#include "replay/level.h"
#include "world/check.h"

namespace reprise::replay {

namespace {

/// A stage of the step, and what it alone writes.
struct Stage {
    const char* name;
    std::uint64_t (world::Digests::*digest)() const;
    std::vector<const char*> tick_fields;
    std::vector<const char*> traffic_fields;
};

const std::array<Stage, 6>& stages() {
    static const std::array<Stage, 6> all{{
        {"scenario",
         &world::Digests::scenario,
         {"commands", "weather", "road_friction", "looks"},
         {}},
        {"controls", &world::Digests::controls, {"controls"}, {}},
        {"traffic", &world::Digests::traffic, {"signals"}, {"cars", "looks"}},
        {"pedestrians", &world::Digests::pedestrians, {}, {"walkers"}},
        {"physics",
         &world::Digests::physics,
         {"vehicles", "wheels", "looks", "props", "doors"},
         {}},
        {"measurements", &world::Digests::measurements, {"measurements"}, {}},
    }};
    return all;
}

/// Which stage raises such an event; index in stages(). Cars of the demand come and go in traffic,
/// what the scenario spawned belongs to the scenario.
std::size_t stage_of(const world::Event& event) {
    const bool is_infraction = event.kind() >= world::EventKind::ran_red_light &&
                               event.kind() <= world::EventKind::wrong_way;
    if (event.kind() == world::EventKind::blocked || is_infraction)
        return 5;
    const bool of_a_crash = event.kind() == world::EventKind::collision ||
                            event.kind() == world::EventKind::wrecked ||
                            event.kind() == world::EventKind::collision_ended;
    if (event.actor() >= world::first_background_id && !of_a_crash)
        return 2;
    return of_a_crash ? 4 : 0;
}

/// "events[3]" of "events[3].text".
std::string event_of(const FieldDifference& difference) {
    return difference.field.substr(0, difference.field.find(']') + 1);
}

/// The earlier one of the stages that raised this event on either side; index in stages().
std::size_t stage_of_event(const std::string& event,
                           const world::Tick& expected,
                           const world::Tick& found) {
    const auto index = static_cast<flatbuffers::uoffset_t>(std::stoul(event.substr(7)));
    std::size_t stage = stages().size();
    for (const world::Tick* tick : {&expected, &found}) {
        if (index < tick->events()->size())
            stage = std::min(stage, stage_of(*tick->events()->Get(index)));
    }
    return stage;
}

/// The first event that differs. Events lie in the order of the stages, so it is also the one of
/// the earliest stage; those behind it may only have moved along.
struct EventDifference {
    std::size_t stage = 0;
    std::vector<FieldDifference> fields;
};

std::optional<EventDifference> first_event_difference(const world::Tick& expected,
                                                      const world::Tick& found,
                                                      Tolerance* tolerance) {
    std::vector<FieldDifference> all =
        differences(*world::TickTypeTable(), &expected, &found, "events", tolerance);
    if (all.empty())
        return std::nullopt;
    const std::string element = event_of(all.front());
    EventDifference difference;
    difference.stage = stage_of_event(element, expected, found);
    std::copy_if(all.begin(),
                 all.end(),
                 std::back_inserter(difference.fields),
                 [&](const FieldDifference& field) { return field.field.starts_with(element); });
    return difference;
}

std::vector<FieldDifference> recorded_differences(const Stage& stage,
                                                  const world::TickView& expected,
                                                  const world::TickView& found,
                                                  Tolerance* tolerance) {
    std::vector<FieldDifference> all;
    const auto add = [&](std::vector<FieldDifference> some) {
        std::move(some.begin(), some.end(), std::back_inserter(all));
    };
    for (const char* field : stage.tick_fields)
        add(differences(*world::TickTypeTable(), expected.tick, found.tick, field, tolerance));
    if (expected.traffic == nullptr || found.traffic == nullptr)
        return all;  // their level leaves it out
    for (const char* field : stage.traffic_fields)
        add(differences(
            *world::TrafficTypeTable(), expected.traffic, found.traffic, field, tolerance));
    return all;
}

std::string hex(std::uint64_t value) {
    return fmt::format("0x{:016x}", value);
}

Divergence of_fields(const std::vector<FieldDifference>& fields) {
    const FieldDifference& first = fields.front();
    Divergence divergence;
    divergence.field = first.field;
    divergence.expected = first.expected;
    divergence.found = first.found;
    divergence.note = first.distance;
    divergence.actor_id = first.actor;
    if (first.actor != 0)
        divergence.actor = fmt::format("actor {}", first.actor);
    if (fields.size() > 1)
        divergence.note += fmt::format("{}{} recorded fields of this stage differ",
                                       divergence.note.empty() ? "" : "; ",
                                       fields.size());
    return divergence;
}

/// Level `inputs` has fields of one stage only; below `keyed` the traffic's are missing.
bool has_fields(const Stage& stage, const world::TickView& tick) {
    const bool inputs = is_inputs_only(*tick.tick);
    return (!inputs || stage.digest == &world::Digests::controls) &&
           (stage.traffic_fields.empty() || tick.traffic != nullptr);
}

Divergence of_digest(const Stage& stage,
                     std::uint64_t expected,
                     std::uint64_t found,
                     bool has_fields) {
    Divergence divergence;
    divergence.unrecorded = true;
    divergence.field = fmt::format("digests.{}", stage.name);
    divergence.expected = hex(expected);
    divergence.found = hex(found);
    divergence.note =
        has_fields
            ? "all recorded fields of this stage agree: its unrounded or unrecorded state differs"
            : "at its level the trace leaves this stage's fields out";
    return divergence;
}

/// The bytes differ, but no stage does.
Divergence of_no_stage(const world::Digests& expected, const world::Digests& found) {
    Divergence divergence;
    divergence.stage = "encoding";
    divergence.field = "bytes";
    divergence.note = "all recorded values agree: one of the ticks was written by another program";
    if (!(expected.state() == found.state())) {
        divergence.field = "digests.state";
        divergence.note = "all stages agree, their common digest does not: a record was changed";
    } else if (!(expected.chain() == found.chain())) {
        divergence.stage = "start";
        divergence.field = "digests.chain";
        divergence.note =
            "this tick agrees; the runs differ before it or in what they started from";
    }
    return divergence;
}

/// Stages in their order; `digests`: what shows only in them counts, too.
std::optional<Divergence> first_stage(const world::TickView& expected,
                                      const world::TickView& found,
                                      bool digests,
                                      Tolerance* tolerance = nullptr) {
    const auto events = first_event_difference(*expected.tick, *found.tick, tolerance);
    for (std::size_t i = 0; i < stages().size(); ++i) {
        const Stage& stage = stages()[i];
        std::vector<FieldDifference> fields =
            recorded_differences(stage, expected, found, tolerance);
        if (events && events->stage == i)
            fields.insert(fields.end(), events->fields.begin(), events->fields.end());
        const std::uint64_t left = (expected.tick->digests()->*stage.digest)();
        const std::uint64_t right = (found.tick->digests()->*stage.digest)();
        if (fields.empty() && (!digests || left == right))
            continue;
        Divergence divergence = fields.empty()
                                    ? of_digest(stage, left, right, has_fields(stage, expected))
                                    : of_fields(fields);
        divergence.stage = stage.name;
        divergence.tick = expected.index();
        return divergence;
    }
    return std::nullopt;
}

void check_same_index(const RecordedTick& expected, const RecordedTick& found) {
    REPRISE_CHECK(expected.view.index() == found.view.index(),
                  fmt::format("ticks {} and {}", expected.view.index(), found.view.index()));
}

}  // namespace

std::string to_text(const Divergence& divergence, std::uint64_t step_ns) {
    std::string text = divergence.tick == 0 ? fmt::format("stage {}", divergence.stage)
                                            : fmt::format("tick {} ({:.2f} s), stage {}",
                                                          divergence.tick,
                                                          world::seconds(divergence.tick, step_ns),
                                                          divergence.stage);
    if (!divergence.actor.empty())
        text += ", " + divergence.actor;
    text += "\n";
    const auto row = [&](const char* key, const std::string& value) {
        if (!value.empty())
            text += fmt::format("  {:<10}{}\n", key, value);
    };
    row("field", divergence.field);
    row("expected", divergence.expected);
    row("found", divergence.found);
    row("note", divergence.note);
    row("script",
        (divergence.script.starts_with("tick") ? "last said at " : "") + divergence.script);
    row("again", divergence.again);
    return text;
}

std::optional<Divergence> compare(const RecordedTick& expected, const RecordedTick& found) {
    if (equal_ticks(expected, found))
        return std::nullopt;
    check_same_index(expected, found);
    const CommonPart common(expected, found);
    if (auto divergence = first_stage(common.expected.view, common.found.view, true))
        return divergence;
    Divergence divergence =
        of_no_stage(*expected.view.tick->digests(), *found.view.tick->digests());
    divergence.tick = expected.view.index();
    return divergence;
}

std::optional<Divergence> compare_recorded(const RecordedTick& expected,
                                           const RecordedTick& found,
                                           Tolerance* tolerance) {
    check_same_index(expected, found);
    const CommonPart common(expected, found);
    return first_stage(common.expected.view, common.found.view, false, tolerance);
}

std::vector<StageDifference> all_differences(const RecordedTick& expected,
                                             const RecordedTick& found,
                                             const std::optional<Tolerance>& tolerance) {
    check_same_index(expected, found);
    const CommonPart common(expected, found);
    const world::TickView& left = common.expected.view;
    const world::TickView& right = common.found.view;
    std::optional<Tolerance> noted = tolerance;
    Tolerance* const tolerated = noted ? &*noted : nullptr;
    const std::vector<FieldDifference> events =
        differences(*world::TickTypeTable(), left.tick, right.tick, "events", tolerated);
    std::vector<StageDifference> all;
    for (std::size_t i = 0; i < stages().size(); ++i) {
        const Stage& stage = stages()[i];
        for (FieldDifference& field : recorded_differences(stage, left, right, tolerated))
            all.push_back({stage.name, std::move(field)});
        for (const FieldDifference& event : events)
            if (stage_of_event(event_of(event), *left.tick, *right.tick) == i)
                all.push_back({stage.name, event});
        const std::uint64_t digest = (left.tick->digests()->*stage.digest)();
        const std::uint64_t other = (right.tick->digests()->*stage.digest)();
        if (!tolerance && digest != other)
            all.push_back(
                {stage.name,
                 {fmt::format("digests.{}", stage.name), hex(digest), hex(other), "", 0}});
    }
    return all;
}

}  // namespace reprise::replay

#include "kernel/drill/nudge.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "kernel/drill/real_fields.h"
#include "world/check.h"

namespace reprise::kernel {

namespace {

constexpr std::int64_t most_units = 1'000'000'000;

[[noreturn]] void fail(const std::string& text, const std::string& what) {
    throw world::Error("--nudge " + text + ": " + what);
}

/// Splits [ACTOR.]FIELD: the longest field there is that it ends with.
void read_target(const std::string& target, Nudge& nudge) {
    const std::vector<std::string> fields = known_fields();
    for (const std::string& field : fields) {
        const bool alone = target == field;
        if ((!alone && !target.ends_with("." + field)) || field.size() < nudge.field.size())
            continue;
        nudge.field = field;
        nudge.actor = alone ? "" : target.substr(0, target.size() - field.size() - 1);
    }
    if (!nudge.field.empty())
        return;
    // The word that was meant for a field: what follows the actor, or all of it.
    const std::size_t dot = target.find('.');
    const std::string word = dot == std::string::npos ? target : target.substr(dot + 1);
    fail(
        nudge.text,
        fmt::format("no recorded number is called '{}'{}; there are steer, position.x, velocity.y, "
                    "speed, wheels[2].rotation, road_friction and others, as diff names them",
                    word,
                    world::did_you_mean(word, fields)));
}

}  // namespace

double moved_by_units(double value, std::int64_t units) {
    return moved<std::int64_t>(value, units_for(value, units));
}

Nudge parse_nudge(const std::string& text) {
    Nudge nudge;
    nudge.text = text;
    const std::size_t first = text.find(':');
    const auto tick = whole<std::uint64_t>(std::string_view(text).substr(0, first));
    if (!tick || text.starts_with('+'))
        fail(text, "expected TICK[:ACTOR.FIELD[:UNITS]] such as 600 or 600:ego.velocity.x");
    nudge.tick = *tick;
    if (first == std::string::npos) {
        nudge.field = "steer";
        return nudge;
    }
    std::string target = text.substr(first + 1);
    const std::size_t last = target.rfind(':');
    if (last != std::string::npos) {
        const auto units = whole<std::int64_t>(std::string_view(target).substr(last + 1));
        if (!units || *units == 0 || *units > most_units || *units < -most_units)
            fail(
                text,
                fmt::format("expected units in the last place, a whole number that is not 0 and at "
                            "most {}, got '{}'",
                            most_units,
                            target.substr(last + 1)));
        nudge.units = *units;
        target.resize(last);
    } else {
        nudge.units = 1;
    }
    read_target(target, nudge);
    return nudge;
}

}  // namespace reprise::kernel

#include "replay/score/infraction.h"

#include <algorithm>

namespace reprise::replay {

namespace {

struct InfractionNames {
    const char* name;
    const char* title;
};

constexpr std::array<InfractionNames, infraction_kinds> infraction_names{{
    {"collision_vehicle", "collisions: vehicle"},
    {"collision_pedestrian", "collisions: pedestrian"},
    {"collision_static", "collisions: fixed"},
    {"opposite_lane", "opposite lane"},
    {"sidewalk", "sidewalk"},
    {"red_light", "red lights"},
    {"stop_sign", "stop signs"},
    {"speeding", "speeding"},
    {"wrong_way", "wrong way"},
    {"off_road", "off the road"},
    {"blocked", "blocked"},
}};

constexpr std::uint64_t longest_violation_ns = 2'000'000'000;

}  // namespace

std::array<InfractionKind, infraction_kinds> all_infractions() {
    std::array<InfractionKind, infraction_kinds> all{};
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = static_cast<InfractionKind>(i);
    return all;
}

const char* name_of(InfractionKind kind) {
    return infraction_names[static_cast<std::size_t>(kind)].name;
}

const char* title_of(InfractionKind kind) {
    return infraction_names[static_cast<std::size_t>(kind)].title;
}

std::uint64_t count_of(const Infraction& infraction, std::uint64_t step_ns) {
    if (infraction.kind == InfractionKind::red_light ||
        infraction.kind == InfractionKind::stop_sign || infraction.kind == InfractionKind::blocked)
        return 1;
    const std::uint64_t lasted = (infraction.last - infraction.first + 1) * step_ns;
    return (lasted + longest_violation_ns - 1) / longest_violation_ns;
}

}  // namespace reprise::replay

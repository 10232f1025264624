#include <algorithm>

#include <fmt/format.h>

#include "replay/mcap/usable.h"
#include "replay/noun_check.h"
#include "world/models/building_models.h"
#include "world/models/catalogue.h"
#include "world/tick.h"
#include "world/town_generated.h"

namespace reprise::replay {

namespace {

bool in_range(std::uint32_t index, std::size_t size) {
    return index == world::none || index < size;
}

bool lane_is_sound(const world::Lane& lane, const world::Town& town) {
    const std::size_t lanes = town.lanes()->size();
    if (!usable(lane.centre()) || lane.centre()->size() < 2 || !usable_or_absent(lane.outline()) ||
        !usable_or_absent(lane.links()) || lane.kind() > world::LaneKind::MAX)
        return false;
    if (!in_range(lane.left(), lanes) || !in_range(lane.right(), lanes) ||
        !in_range(lane.opposite(), lanes) || !in_range(lane.junction(), town.junctions()->size()))
        return false;
    if (lane.links() == nullptr)
        return true;
    for (const world::Link* link : *lane.links()) {
        if (!in_range(link->to(), lanes) || !in_range(link->via(), lanes) ||
            !in_range(link->signal(), town.signals()->size()) || link->turn() > world::Turn::MAX)
            return false;
    }
    return true;
}

template <typename Vector, typename Sound>
bool all(const Vector* items, const Sound& sound) {
    return items == nullptr || std::all_of(items->begin(), items->end(), [&](const auto* item) {
               return sound(*item);
           });
}

bool head_is_sound(const world::SignalHead& head, const world::Town& town) {
    return head.foot() != nullptr && head.signals()->size() > 0 &&
           std::all_of(head.signals()->begin(), head.signals()->end(), [&](std::uint32_t signal) {
               return signal < town.signals()->size();
           });
}

bool prop_is_known(const world::Prop& prop) {
    return prop.kind() <= world::PropKind::MAX && (prop.kind() != world::PropKind::parked_vehicle ||
                                                   prop.value() < world::vehicle_models().size());
}

/// What stands in the town is of kinds that we know, and refers to what is there.
std::optional<std::string> fault_of_scenery(const world::Town& town) {
    const std::size_t models = world::building_models().size();
    const auto known = [&](const auto& building) { return building.model() <= models; };
    if (!all(town.buildings(), known) || !all(town.drawn_buildings(), known))
        return "a building of an unknown model";
    if (!all(town.trees(),
             [](const world::Tree& tree) { return tree.kind() <= world::PlantKind::MAX; }))
        return "a plant of an unknown kind";
    if (!all(town.props(), prop_is_known))
        return "furniture of an unknown kind";
    const auto drawn = [](const auto& outlined) {
        return usable(outlined.outline()) && outlined.outline()->size() >= 3;
    };
    if (!all(town.drawn_buildings(), drawn) || !all(town.plots(), drawn) ||
        !all(town.plots(),
             [](const world::Plot& plot) { return plot.kind() <= world::PlotKind::MAX; }))
        return "an outline that is none";
    if (!all(town.heads(), [&](const auto& head) { return head_is_sound(head, town); }))
        return "a signal head of no signal";
    const std::size_t lanes = town.lanes()->size();
    if (!all(town.spawn_points(), [&](const auto& point) { return in_range(point.lane(), lanes); }))
        return "a spawn point on no lane";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> fault_of_town(mcap::View bytes) {
    auto check = verifier(bytes);
    if (!world::VerifyTownBuffer(check))
        return "not a Town";
    const world::Town& town = *world::GetTown(bytes.data());
    for (const world::Lane* lane : *town.lanes()) {
        if (!lane_is_sound(*lane, town))
            return fmt::format("lane {} is not sound", lane->name()->str());
    }
    for (const world::Junction* junction : *town.junctions()) {
        if (!usable_or_absent(junction->outline()))
            return fmt::format("junction {} is not sound", junction->name()->str());
    }
    for (const world::Signal* signal : *town.signals()) {
        if (!in_range(signal->lane(), town.lanes()->size()))
            return fmt::format("signal {} is not sound", signal->program()->str());
    }
    if (!usable_or_absent(town.buildings()) || !usable_or_absent(town.trees()) ||
        !usable_or_absent(town.props()) || !usable_or_absent(town.spawn_points()))
        return "its buildings, plants, furniture or spawn points are not aligned";
    return fault_of_scenery(town);
}

}  // namespace reprise::replay

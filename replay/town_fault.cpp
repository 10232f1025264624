#include <algorithm>

#include <fmt/format.h>

#include "replay/noun_check.h"
#include "replay/struct_vector.h"
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
    if (!is_aligned(lane.centre()) || lane.centre()->size() < 2 || !is_aligned(lane.outline()) ||
        !is_aligned(lane.links()) || lane.kind() > world::LaneKind::MAX)
        return false;
    if (!in_range(lane.left(), lanes) || !in_range(lane.right(), lanes) ||
        !in_range(lane.opposite(), lanes) || !in_range(lane.junction(), town.junctions()->size()))
        return false;
    for (const world::Link* link : *lane.links()) {
        if (!in_range(link->to(), lanes) || !in_range(link->via(), lanes) ||
            !in_range(link->signal(), town.signals()->size()) || link->turn() > world::Turn::MAX)
            return false;
    }
    return true;
}

template <typename Vector, typename Sound>
bool all(const Vector* items, const Sound& sound) {
    return std::all_of(
        items->begin(), items->end(), [&](const auto* item) { return sound(*item); });
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

/// Buildings, plants and furniture are of known kinds; signal heads and spawn points name signals
/// and lanes of this town.
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
        return is_aligned(outlined.outline()) && outlined.outline()->size() >= 3;
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
        if (!is_aligned(junction->outline()))
            return fmt::format("junction {} is not sound", junction->name()->str());
    }
    for (const world::Signal* signal : *town.signals()) {
        if (!in_range(signal->lane(), town.lanes()->size()))
            return fmt::format("signal {} is not sound", signal->program()->str());
    }
    if (!is_aligned(town.buildings()) || !is_aligned(town.trees()) || !is_aligned(town.props()) ||
        !is_aligned(town.spawn_points()) || town.drawn_buildings() == nullptr ||
        town.plots() == nullptr || town.heads() == nullptr)
        return "its buildings, plots, plants, furniture, signal heads or spawn points are missing "
               "or misplaced";
    return fault_of_scenery(town);
}

}  // namespace reprise::replay

// What it must do: find every place that heights spoil, by measuring the town that comes out.
// What it assumes: flat towns have neither ramps nor roads above each other.
// How it goes: ramps and headroom lane by lane; then the criteria of `town check`. What is dear
// comes
//   last, and only when all before it is well. What the flat town has wrong as well is no fault.
// What it keeps: the criteria of the flat town, once they were asked for.
#include "towns/bridges/height_faults.h"

#include <algorithm>
#include <cmath>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/ground_probe.h"
#include "towns/bridges/height_profile.h"
#include "towns/check/furniture_check.h"
#include "towns/check/ground_check.h"
#include "towns/check/standing_check.h"
#include "towns/check/walk_check.h"
#include "walkers/map/walk_map.h"
#include "world/frames.h"
#include "world/lane_starts.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

using towns::Criterion;

constexpr double steepest_ramp = 0.15;
constexpr double step = 1;        ///< [m] between plumb lines along a lane
constexpr double surface = 0.5;   ///< [m] above a lane: not another road, but its own
constexpr double headroom = 4.8;  ///< [m] for lorries, and the deck above them

void find_ramps(const world::TownT& town, std::vector<HeightFault>& faults) {
    for (const world::LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i) {
            const Eigen::Vector3d from = world::to_eigen(lane.centre[i]);
            const Eigen::Vector3d to = world::to_eigen(lane.centre[i + 1]);
            if (steepest({from, to}) > steepest_ramp)
                faults.push_back({HeightFault::Kind::steep, ((from + to) / 2).head<2>()});
        }
    }
}

/// The first place of each lane that has something too low above it.
void find_low_roads(const world::TownT& town,
                    const ground::GroundProbe& probe,
                    std::vector<HeightFault>& faults) {
    for (const world::LaneT& lane : town.lanes) {
        const world::LaneStarts starts(lane);
        for (double s = step / 2; s < lane.length; s += step) {
            const Eigen::Vector3d p = starts.at(lane, s).position;
            const auto hit = probe.below(p + headroom * Eigen::Vector3d::UnitZ());
            if (!hit || hit->surface == ground::Surface::terrain || hit->z < p.z() + surface)
                continue;
            faults.push_back({HeightFault::Kind::low, p.head<2>()});
            break;
        }
    }
}

bool all_pass(const std::vector<Criterion>& criteria) {
    return std::all_of(criteria.begin(), criteria.end(), [](const Criterion& criterion) {
        return criterion.passed();
    });
}

}  // namespace

/// In the flat town, too?
bool HeightFaultFinder::was_there(const Criterion& criterion, const Criterion::Place& place) {
    if (!criteria_of_flat_) {
        const world::TownT town = read_town(flat_);
        const ground::GroundMesh ground = ground::build_ground(town);
        criteria_of_flat_ = towns::check_ground(town, ground);
        criteria_of_flat_->push_back(check_walking(town, walkers::WalkMap(ground)));
        for (Criterion& each : towns::check_furniture(town))
            criteria_of_flat_->push_back(std::move(each));
        for (Criterion& each : towns::check_standing(town, ground))
            criteria_of_flat_->push_back(std::move(each));
    }
    for (const Criterion& flat : *criteria_of_flat_)
        if (flat.name == criterion.name)
            return std::any_of(flat.worst.begin(), flat.worst.end(), [&](const auto& known) {
                return known.name == place.name;
            });
    return false;
}

std::vector<HeightFault> HeightFaultFinder::faults(const std::string& xml) {
    const Network network{flat_.name, xml, "", flat_.place};
    std::vector<HeightFault> found;
    find_ramps(read_streets(network), found);
    if (!found.empty())
        return found;
    const world::TownT town = read_town(network);
    const ground::GroundMesh ground = ground::build_ground(town);
    find_low_roads(town, ground::GroundProbe(ground), found);
    std::vector<Criterion> criteria = towns::check_ground(town, ground);
    if (found.empty() && all_pass(criteria)) {
        criteria.push_back(check_walking(town, walkers::WalkMap(ground)));
        for (Criterion& each : towns::check_furniture(town))
            criteria.push_back(std::move(each));
        for (Criterion& each : towns::check_standing(town, ground))
            criteria.push_back(std::move(each));
    }
    for (const Criterion& criterion : criteria)
        if (!criterion.passed())
            for (const Criterion::Place& place : criterion.worst)
                if (!was_there(criterion, place))
                    found.push_back({HeightFault::Kind::ground, place.position});
    return found;
}

}  // namespace reprise::towns

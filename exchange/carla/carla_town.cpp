#include "exchange/carla/carla_town.h"

#include "world/frames.h"
#include "world/tick.h"

namespace reprise::exchange {

namespace {

using Eigen::Vector3d;

constexpr double border = 50;  // [m]

std::uint32_t nearest_light(const Vector3d& place,
                            const CarlaSurvey& survey,
                            const Vector3d& offset) {
    std::uint32_t nearest = 0;
    double least = survey.lights_have_triggers ? 12 : 40;
    for (const auto& [id, light] : survey.lights) {
        const double distance = (light + offset - place).head<2>().norm();
        if (distance < least) {
            least = distance;
            nearest = id;
        }
    }
    return nearest;
}

}  // namespace

world::TownT plain_town(const CarlaSurvey& survey) {
    const Vector3d margin(border, border, 0);
    Vector3d low = survey.low - margin;
    Vector3d high = survey.high + margin;
    low.z() = high.z() = survey.height;
    const double middle = (low.y() + high.y()) / 2;
    world::LaneT lane;
    lane.name = "plain_0";
    lane.edge = "plain";
    lane.kind = world::LaneKind::other;
    lane.centre = {world::Vec3(low.x(), middle, low.z()), world::Vec3(high.x(), middle, low.z())};
    lane.width = high.y() - low.y();
    lane.length = lane.sumo_length = high.x() - low.x();
    lane.left = lane.right = lane.opposite = lane.junction = world::none;
    world::TownT town;
    town.name = "plain";
    town.lanes.push_back(std::move(lane));
    town.low = world::to_vec3(low);
    town.high = world::to_vec3(high);
    return town;
}

std::vector<std::uint32_t> match_signals(const world::TownT& town,
                                         const CarlaSurvey& survey,
                                         const Vector3d& offset) {
    std::vector<std::uint32_t> lights;
    for (const world::SignalT& signal : town.signals)
        lights.push_back(signal.for_walkers
                             ? 0
                             : nearest_light(world::to_eigen(signal.position), survey, offset));
    return lights;
}

}  // namespace reprise::exchange

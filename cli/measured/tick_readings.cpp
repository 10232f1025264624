#include "cli/measured/tick_readings.h"

#include "render/readings/readings.h"
#include "world/external/sensor_attributes.h"

namespace reprise::cli {

using world::SensorKind;

std::vector<world::Reading> TickReadings::read(const world::TickView* last,
                                               const world::TickView& tick,
                                               const world::SensorSpec& spec,
                                               bool due) {
    std::vector<world::Reading> found;
    switch (spec.kind) {
        case SensorKind::gnss:
            if (due)
                found.push_back(gnss(tick, spec));
            return found;
        case SensorKind::imu:
            if (due)
                found.push_back(render::imu_reading(last, tick, spec));
            return found;
        case SensorKind::collision:
            return render::collision_readings(tick, spec);
        default:
            if (last == nullptr)
                return found;
            if (!lanes_)
                lanes_.emplace(town_);
            return render::lane_invasion_readings(*last, tick, spec, town_, *lanes_);
    }
}

world::Reading TickReadings::gnss(const world::TickView& tick,
                                  const world::SensorSpec& spec) const {
    const Eigen::Vector3d place = render::antenna_place(tick, spec);
    render::GlobePlace on_globe;
    if (origin_) {
        const exchange::Geodetic there = origin_->at(world::Vec3(place.x(), place.y(), place.z()));
        on_globe = {there.latitude_deg, there.longitude_deg};
    } else {
        on_globe = render::place_on_globe(
            {world::attribute(spec, "latitude"), world::attribute(spec, "longitude")},
            place.x(),
            place.y());
    }
    return render::gnss_reading(tick.index(), spec, on_globe, place.z());
}

}  // namespace reprise::cli

#include "traffic/sight/swing.h"

#include <algorithm>
#include <cmath>

#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

bool swings_into_any(const Car& car,
                     const world::LaneT& lane,
                     const world::LaneProjection& at,
                     double aside,
                     double pace,
                     std::span<const Footprint> footprints) {
    constexpr double sample = 0.05;   // [s]
    constexpr double quickest = 3;    // [m/s^2] the less time to get aside
    constexpr double look_ahead = 3;  // [s]
    constexpr double short_car = 7;   // [m] the side of a longer one cuts the corner much later
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    Trail trail = car.trail;
    double driving = 0;  // [m/s]
    double driven = 0;   // [m]
    double offset = 0;   // [m] from where it is now, as CarReader::move_aside has it
    const double tail = model.length > short_car ? model.length : 0;
    for (double time = sample; time < look_ahead || driven < look_ahead * pace + tail;
         time += sample) {
        driving = std::min(driving + quickest * sample, pace);
        driven += driving * sample;
        const double wanted = (aside - car.offset) * std::min(time / pull_out_time, 1.0);
        offset += std::clamp(wanted - offset, -driving * sample, driving * sample);
        const world::LanePoint on = world::point_at(lane, at.s + driven);
        const Eigen::Vector2d left = world::turned_left(world::ahead_of(on.yaw));
        Eigen::Vector3d front = on.position;
        front.head<2>() += (at.t + offset) * left;
        trail.advance(front);
        BodyBox body;
        body.ahead = (front - trail.rear()).head<2>().normalized();
        body.half_length = model.length / 2;
        body.half_width = model.width / 2;
        body.middle = front.head<2>() - model.length / 2 * body.ahead;
        for (const Footprint& one : footprints) {
            const BodyBox other{one.centre, one.direction, one.half_length, one.half_width};
            if (one.id != car.id && std::abs(one.z - car.rear.z()) < world::level_clearance &&
                overlap(body, other.widened(one.clearance)))
                return true;
        }
    }
    return false;
}

}  // namespace reprise::traffic

#include "walkers/things.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/actors.h"
#include "world/models/catalogue.h"
#include "world/models/doors.h"
#include "world/models/prop_models.h"

namespace reprise::walkers {

namespace {

constexpr double beside_cars = 0.1;   // [m] that a body is wider than the thing
constexpr double stands = 0.3;        // [m/s]
constexpr double least_height = 0.1;  // [m] what is lower is stepped over

/// Seen from above.
struct Thing {
    Eigen::Vector2d middle;
    Eigen::Vector2d ahead;
    double half_length = 0;
    double half_width = 0;
    Eigen::Vector2d velocity{0, 0};
    double turning = 0;           ///< [rad/s] counter-clockwise, around `pivot`
    Eigen::Vector2d pivot{0, 0};  ///< rear axle: what moves at `velocity`
    std::uint32_t id = 0;
    bool drives = false;

    /// [m/s] of a place on it: a bus's tail swings out while the bus drives on.
    Eigen::Vector2d velocity_at(const Eigen::Vector2d& place) const {
        return velocity + turning * world::turned_left(place - pivot);
    }
};

/// Of a car's corners a quarter of a metre looks out of the circle around its end.
void add_corners(const Thing& thing, Neighbours& neighbours) {
    constexpr double round = 0.3;  // [m]
    constexpr double broad = 0.6;  // [m] half of it, from which on that is enough to be walked into
    if (std::min(thing.half_length, thing.half_width) < broad)
        return;
    const Eigen::Vector2d along = (thing.half_length - round) * thing.ahead;
    const Eigen::Vector2d across = (thing.half_width - round) * world::turned_left(thing.ahead);
    for (const Eigen::Vector2d& corner :
         {Eigen::Vector2d(along + across), Eigen::Vector2d(along - across)})
        for (const double end : {1.0, -1.0}) {
            const Eigen::Vector2d place = thing.middle + end * corner;
            neighbours.add({place, thing.velocity_at(place), round + beside_cars, thing.id},
                           thing.drives);
        }
}

void add(const Thing& thing, Neighbours& neighbours) {
    const bool lies_along = thing.half_length >= thing.half_width;
    const Eigen::Vector2d along = lies_along ? thing.ahead : world::turned_left(thing.ahead);
    const double half = std::max(thing.half_length, thing.half_width);
    const double radius = std::min(thing.half_length, thing.half_width) + beside_cars;
    const double inner = radius - beside_cars;
    const double end = half - inner;
    // Between two of them the thing must not look out: a bus's would, by a hand's breadth.
    const double apart = std::min(radius, 2 * std::sqrt(radius * radius - inner * inner));
    const int count = 1 + static_cast<int>(std::ceil(2 * end / apart));
    for (int i = 0; i < count; ++i) {
        const double at = count > 1 ? -end + 2 * end * i / (count - 1) : 0;
        const Eigen::Vector2d place = thing.middle + at * along;
        neighbours.add({place, thing.velocity_at(place), radius, thing.id}, thing.drives);
    }
    add_corners(thing, neighbours);
}

Thing car_of(const RoadUser& car) {
    const world::Extent extent = world::extent_of(world::vehicle_models()[car.model]);
    Thing thing;
    thing.ahead = world::ahead_of(car.yaw);
    thing.pivot = car.rear_axle;
    thing.middle = car.rear_axle + extent.middle() * thing.ahead;
    thing.half_length = (extent.front - extent.rear) / 2;
    thing.half_width = extent.half_width;
    thing.id = car.id;
    return thing;
}

/// Can any of them come close to a car within a tick?
bool is_near(const RoadUser& car, const Places& people) {
    constexpr double close = 5;  // [m] more than anybody looks around himself
    return people.any_within(car.rear_axle, world::vehicle_models()[car.model].length + close);
}

void add_users(std::span<const RoadUser> users,
               const Places& on_road,
               const Places& people,
               Neighbours& neighbours) {
    for (const RoadUser& user : users) {
        // One that stands may reach over the kerb with a corner: nobody walks through it there.
        const bool drives = user.velocity.norm() > stands;
        if (!is_near(user, drives ? on_road : people))
            continue;
        Thing thing = car_of(user);
        thing.velocity = user.velocity;
        thing.turning = user.yaw_rate;
        thing.drives = drives;
        add(thing, neighbours);
    }
}

void add_props(const world::TickView& last, Neighbours& neighbours) {
    for (const world::PropState& prop : last.props()) {
        const world::PropModel& model = world::prop_models()[prop.model()];
        if (model.height < least_height)
            continue;
        const Eigen::Vector3d ahead =
            world::to_eigen(prop.orientation()) * Eigen::Vector3d::UnitX();
        Thing thing;
        thing.middle = world::in_plan(prop.position());
        thing.ahead = world::ahead_of(std::atan2(ahead.y(), ahead.x()));
        thing.half_length = model.length / 2;
        thing.half_width = model.width / 2;
        thing.velocity = {prop.velocity().x(), prop.velocity().y()};
        thing.id = prop.id();
        add(thing, neighbours);
    }
}

void add_doors(const world::TickView& last, Neighbours& neighbours) {
    for (const world::Door& door : last.doors()) {
        const world::VehicleState* vehicle = world::find(last.vehicles(), door.actor());
        const world::CarState* car = world::find(last.cars(), door.actor());
        if (vehicle == nullptr && car == nullptr)
            continue;
        const Eigen::Isometry3d pose =
            vehicle != nullptr ? world::pose(vehicle->position(), vehicle->orientation())
                               : world::pose(car->position(),
                                             static_cast<double>(car->yaw()),
                                             static_cast<double>(car->pitch()));
        const std::uint16_t model = vehicle != nullptr ? vehicle->model() : car->model();
        const world::DoorLeaf leaf =
            world::door_leaf(world::vehicle_models()[model], pose, door.door(), door.angle());
        Thing thing;
        thing.middle = leaf.pose.translation().head<2>();
        thing.ahead = leaf.pose.linear().col(0).head<2>().normalized();
        thing.half_length = leaf.half.x();
        thing.half_width = leaf.half.y();
        thing.id = door.actor();
        add(thing, neighbours);
    }
}

}  // namespace

void add_things(const world::TickView& last,
                std::span<const RoadUser> users,
                const Places& on_road,
                const Places& people,
                Neighbours& neighbours) {
    add_users(users, on_road, people, neighbours);
    add_props(last, neighbours);
    add_doors(last, neighbours);
}

}  // namespace reprise::walkers

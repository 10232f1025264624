#include "towns/furnish/parked_cars.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "ground/mesh/ground.h"
#include "towns/furnish/props.h"
#include "world/lane_starts.h"
#include "world/models/catalogue.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::Purpose;
using world::VehicleModel;

constexpr double longest_car = 5;
constexpr double bay = 2.5;  ///< [m] between the middles of two bays
constexpr double bay_depth = 5;
constexpr double aisle = 6;
constexpr double taken = 0.6;           ///< share of the bays
constexpr double car_from_kerb = 0.25;  ///< [m] of a car parked along it

std::uint32_t longest_side(const world::Loop& loop) {
    std::uint32_t best = 0;
    double longest = 0;
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
        const double length = (loop[(i + 1) % loop.size()] - loop[i]).norm();
        if (length > longest) {
            longest = length;
            best = i;
        }
    }
    return best;
}

bool holds(const world::Loop& outline, const Footprint& footprint) {
    for (const Vector2d& corner : corners(footprint))
        if (!world::contains(outline, corner))
            return false;
    return true;
}

}  // namespace

std::uint16_t choose_parked_model(Draws& draws) {
    std::vector<std::uint16_t> cars;
    for (std::uint16_t i = 0; i < world::vehicle_models().size(); ++i) {
        const VehicleModel& model = world::vehicle_models()[i];
        if (std::string_view(model.sumo_class) == "passenger" && model.length < longest_car)
            cars.push_back(i);
    }
    return cars[draws.index(cars.size())];
}

bool park(
    PlacementContext& context, const Vector2d& middle, double yaw, double road_z, Draws& draws) {
    const std::uint16_t model = choose_parked_model(draws);
    const VehicleModel& car = world::vehicle_models()[model];
    PropCandidate candidate;
    candidate.kind = world::PropKind::parked_vehicle;
    candidate.footprint = {middle, yaw, car.length, car.width};
    candidate.height = car.height;
    candidate.road_z = road_z;
    candidate.from_solid = 0.3;
    candidate.from_walk = 0.1;
    candidate.style = draws.style();
    candidate.value = model;
    return place_prop(context, candidate);
}

void fill_car_park(PlacementContext& context,
                   const world::Loop& outline,
                   double road_z,
                   Draws& draws) {
    if (outline.size() < 3)
        return;
    const std::uint32_t side = longest_side(outline);
    const Vector2d x = (outline[(side + 1) % outline.size()] - outline[side]).normalized();
    const Vector2d y(-x.y(), x.x());
    const double yaw = std::atan2(y.y(), y.x());
    world::Box box;
    for (const Vector2d& p : outline)
        box.take({(p - outline[side]).dot(x), (p - outline[side]).dot(y)});
    // Bays on both sides of an aisle, then the next two rows back to back with them.
    bool nose_in = false;
    double v = box.low.y() + 0.5 + bay_depth / 2;
    for (; v < box.high.y() - bay_depth / 2; v += nose_in ? bay_depth + aisle : bay_depth + 0.4) {
        nose_in = !nose_in;
        for (double u = box.low.x() + 0.5 + bay / 2; u < box.high.x() - bay / 2; u += bay) {
            const Vector2d middle = outline[side] + x * u + y * v;
            const bool wanted = draws.chance(taken);
            const bool turned = draws.chance(0.5);
            if (wanted && holds(outline, {middle, yaw, bay_depth, bay - 0.2}))
                park(context, middle, turned ? yaw + std::numbers::pi : yaw, road_z, draws);
        }
    }
}

void park_along_wide_lanes(PlacementContext& context) {
    const double side = context.town.left_hand ? 1 : -1;
    for (std::uint32_t i = 0; i < context.roadsides.size(); ++i) {
        const Roadside& roadside = context.roadsides[i];
        if (!roadside.kerb_side || roadside.driven == world::none)
            continue;
        const world::LaneT& lane = context.town.lanes[roadside.driven];
        const world::LaneStarts starts(lane);
        Draws draws(context.seed, Purpose::furniture, 3ULL << 32 | i);
        for (double s = 20; s < lane.length - 20; s += 6.5) {
            const std::uint16_t model = choose_parked_model(draws);
            const VehicleModel& car = world::vehicle_models()[model];
            const double offset = lane.width / 2 - car_from_kerb - car.width / 2;
            const world::LanePoint at = starts.at(lane, s);
            const Vector2d middle =
                at.position.head<2>() + world::left_of(at.yaw) * (side * offset);
            const Footprint footprint{middle, at.yaw, car.length, car.width};
            if (offset - car.width / 2 < ground::car_clearance + 0.2 || draws.chance(0.4) ||
                !context.solid.is_clear(footprint, 0.8) ||
                !context.crossings.is_clear(footprint, 5))
                continue;
            const auto ground = context.ground_heights.under(footprint, at.position.z());
            if (!ground || ground->rise() > car_slope)
                continue;
            context.solid.add_footprint(footprint);
            const double z = (ground->low + ground->high) / 2;
            context.town.props.emplace_back(world::Vec3(middle.x(), middle.y(), z),
                                            at.yaw,
                                            car.length,
                                            car.width,
                                            car.height,
                                            draws.style(),
                                            model,
                                            world::PropKind::parked_vehicle,
                                            std::uint8_t{0});
        }
    }
}

}  // namespace reprise::towns

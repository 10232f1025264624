#include "traffic/sight/pushing_past.h"

#include <algorithm>

#include "traffic/sight/swing.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

constexpr std::uint64_t pushes_for = 240;  // [ticks]
constexpr double leans_beside = 0.1;       // [m] from who is pushed past
constexpr double leans_within = 0.5;       // [s]

}  // namespace

/// Of the two the one who is less in the other one's body on his way; through it nobody drives.
void PushingPast::begin(MetDriver& one, MetDriver& other, std::uint64_t tick) const {
    const Foresight::Intrusion depth = one.seen->deepest_in(other.seen->now(), one.reach);
    const Foresight::Intrusion its_depth = other.seen->deepest_in(one.seen->now(), other.reach);
    const bool is_one = depth.depth <= its_depth.depth;
    const Foresight::Intrusion& least = is_one ? depth : its_depth;
    if (least.depth > deepest)
        return;
    MetDriver& driver = is_one ? one : other;
    if (driver.pushes_until <= tick)
        driver.pushes_past.clear();
    driver.pushes_past.push_back(is_one ? other.car->id : one.car->id);
    driver.pushes_until = tick + pushes_for;
    driver.leans = lean_for(driver, least);
}

/// [m] left: out of the other one's body, as far as its lanes are wide. Not of who is beside its
/// rear: as the nose goes aside the tail swings to the other side, and deeper in.
double PushingPast::lean_for(const MetDriver& driver, const Foresight::Intrusion& intrusion) const {
    if (intrusion.depth == 0 || intrusion.is_behind)
        return 0;
    double spare = world::infinity;  // [m] at each side
    for (const std::uint32_t lane : driver.seen->way().lanes())
        spare = std::min(spare, lines_->town().lanes[lane].width / 2);
    spare -= world::vehicle_models()[driver.car->model].width / 2;
    const double metres = std::clamp(intrusion.depth + leans_beside, 0.0, std::max(spare, 0.0));
    return intrusion.is_left ? -metres : metres;
}

/// By an offset from its lane, until it has pushed past.
void PushingPast::steer(Car& car, const MetDriver& driver, std::uint64_t tick) {
    const double wanted = driver.leans;
    const bool is_past = car.pushes_until <= tick;
    if (wanted != 0 && !car.offset_order && car.offset == 0) {
        car.offset_order = OffsetOrder{{0, wanted, leans_within, world::Shape::linear}, tick - 1};
        car.leans = true;
    } else if (car.leans && is_past && car.offset_order && car.offset_order->change.to != 0) {
        car.offset_order =
            OffsetOrder{{car.offset, 0, pull_out_time, world::Shape::linear}, tick - 1};
    }
    car.leans = car.leans && car.offset_order;
}

bool PushingPast::has_begun(const MetDriver& driver, const MetDriver& other, std::uint64_t tick) {
    const auto& ids = driver.pushes_past;
    return driver.pushes_until > tick &&
           std::find(ids.begin(), ids.end(), other.car->id) != ids.end();
}

}  // namespace reprise::traffic

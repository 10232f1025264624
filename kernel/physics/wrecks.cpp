#include "kernel/physics/wrecks.h"

#include <algorithm>
#include <utility>

namespace reprise::kernel {

namespace {

/// [m] What may come between where somebody is expected and where he is: a push within the tick.
constexpr double push_room = 2;

bool is_one_of(const Vehicles& vehicles, std::uint32_t id) {
    return std::any_of(vehicles.begin(), vehicles.end(), [id](const auto& vehicle) {
        return vehicle->id() == id;
    });
}

}  // namespace

std::vector<Wrecks::Pusher> Wrecks::pushers(const Vehicles& vehicles, const Props& props) const {
    std::vector<Pusher> all;
    const auto add = [&](std::uint32_t id, const PlacedBox& box, const btVector3& velocity) {
        all.push_back({id, box, box.half.length() + velocity.length() * step_});
    };
    for (const auto& vehicle : vehicles)
        add(vehicle->id(), vehicle->box(), vehicle->body().getLinearVelocity());
    for (const Props::Heavy& prop : props.heavy())
        add(prop.id, prop.box, prop.velocity);
    return all;
}

void Wrecks::find_near(const NearCars& cars, std::span<const Pusher> pushers) {
    near_.clear();
    for (std::size_t i = 0; i < cars.size(); ++i) {
        const auto way = cars.way(i);
        if (!way)
            continue;
        const btVector3 here = cars.pose_at(i, 0).getOrigin();
        const double room = way->half.length() + way->length + push_room;
        if (std::any_of(pushers.begin(), pushers.end(), [&](const Pusher& pusher) {
                const double both = room + pusher.room;
                return pusher.box.pose.getOrigin().distance2(here) < both * both;
            }))
            near_.push_back(i);
    }
}

void Wrecks::begin(const NearCars& cars,
                   const Vehicles& vehicles,
                   const Props& props,
                   CarCrashes crashes) {
    crashes_ = std::move(crashes);
    trials_.clear();
    made_.clear();
    loose_.clear();
    derailed_.clear();
    heavy_props_.clear();
    for (const Props::Heavy& prop : props.heavy())
        heavy_props_.push_back(prop.id);
    find_near(cars, pushers(vehicles, props));
}

std::vector<Vehicle*> Wrecks::stand_in(
    double before, double after, NearCars& cars, Vehicles& vehicles, const Props& props) {
    std::vector<Vehicle*> stand_ins;
    if (before == 0 && !crashes_.empty())
        for (std::size_t index = 0; index < cars.size(); ++index)
            if (const auto way = cars.way(index); way && drives_into_one(way->id))
                stand_ins.push_back(&replace(index, before, cars, vehicles));
    if (near_.empty() && stand_ins.empty())
        return stand_ins;
    for (bool again = true; again;) {
        again = false;
        const std::vector<Pusher> all = pushers(vehicles, props);
        if (!trials_.empty())
            find_near(cars, all);  // who is hit may go anywhere
        for (const std::size_t index : near_) {
            const PlacedBox from{cars.pose_at(index, before), cars.way(index)->half};
            const PlacedBox to{cars.pose_at(index, after), from.half};
            const double room = from.half.length() + cars.way(index)->length + reach;
            if (std::none_of(all.begin(), all.end(), [&](const Pusher& pusher) {
                    const double both = room + pusher.room;
                    return pusher.box.pose.getOrigin().distance2(from.pose.getOrigin()) <
                               both * both &&
                           (gap_between(from, pusher.box) < reach ||
                            gap_between(to, pusher.box) < reach);
                }))
                continue;
            stand_ins.push_back(&replace(index, before, cars, vehicles));
            again = true;
        }
    }
    return stand_ins;
}

Vehicle& Wrecks::replace(std::size_t index, double share, NearCars& cars, Vehicles& vehicles) {
    const NearCars::Way car = *cars.way(index);
    const NearCars::Motion motion = cars.motion(index, step_);
    const Eigen::Isometry3d pose_world_vehicle = cars.car_at(index, share);
    const btVector3 middle = cars.pose_at(index, share).getOrigin();
    cars.take_out(index);
    auto vehicle = std::make_unique<Vehicle>(
        car.id, car.model, *world_, *ground_, pose_world_vehicle, 0, Balance::lost);
    vehicle->move_as(motion.velocity, motion.spin, middle);
    const auto at = std::lower_bound(
        vehicles.begin(), vehicles.end(), car.id, [](const auto& other, std::uint32_t id) {
            return other->id() < id;
        });
    const auto trial = std::lower_bound(
        trials_.begin(), trials_.end(), car.id, [](const Trial& other, std::uint32_t id) {
            return other.id < id;
        });
    trials_.insert(trial, {car.id, motion.velocity.length(), 0});
    return **vehicles.insert(at, std::move(vehicle));
}

bool Wrecks::drives_into_one(std::uint32_t id) const {
    return std::any_of(crashes_.begin(), crashes_.end(), [id](const auto& pair) {
        return pair.first == id || pair.second == id;
    });
}

bool Wrecks::drove_into(std::uint32_t one, std::uint32_t other) const {
    return std::binary_search(crashes_.begin(), crashes_.end(), std::minmax({one, other}));
}

/// Who hit it, of those who may: what had mass before, those who were hit by that, and whom it
/// drove into. 0: nobody.
std::uint32_t Wrecks::hit_by(const Trial& trial,
                             const Touching& touching,
                             const Vehicles& vehicles) const {
    for (const auto& [actor, other] : touching) {
        if (actor != trial.id)
            continue;
        const std::uint32_t pusher = other;
        const auto stands_in = std::find_if(
            trials_.begin(), trials_.end(), [&](const Trial& one) { return one.id == pusher; });
        const bool was_hit = stands_in != trials_.end() && stands_in->by != 0;
        const bool had_mass =
            stands_in == trials_.end() &&
            (is_one_of(vehicles, pusher) ||
             std::binary_search(heavy_props_.begin(), heavy_props_.end(), pusher));
        if (was_hit || had_mass || drove_into(trial.id, pusher))
            return pusher;
    }
    return 0;
}

std::vector<Vehicle*> Wrecks::break_loose(double before, Vehicles& vehicles) {
    std::vector<Vehicle*> loose;
    const auto may_hit = [](const Vehicle& one, const Vehicle& other) {
        const PlacedBox box = one.box();
        const PlacedBox beside = other.box();
        const double room = box.half.length() + beside.half.length() + reach;
        return &one != &other &&
               beside.pose.getOrigin().distance2(box.pose.getOrigin()) < room * room &&
               gap_between(box, beside) < reach;
    };
    for (const auto& vehicle : vehicles)
        if (vehicle->is_guided() &&
            std::any_of(vehicles.begin(), vehicles.end(), [&](const auto& other) {
                return may_hit(*vehicle, *other);
            }))
            loose.push_back(vehicle.get());
    for (Vehicle* vehicle : loose) {
        vehicle->break_loose(before);
        loose_.insert(std::lower_bound(loose_.begin(), loose_.end(), vehicle->id()), vehicle->id());
    }
    return loose;
}

/// Those who touched no other one are where their trajectory says.
void Wrecks::decide_loose(const Collisions& collisions, Vehicles& vehicles) {
    if (loose_.empty())
        return;
    const Touching touching = collisions.touching();
    for (const auto& vehicle : vehicles) {
        if (!std::binary_search(loose_.begin(), loose_.end(), vehicle->id()))
            continue;
        const bool crashed = std::any_of(touching.begin(), touching.end(), [&](const auto& pair) {
            return pair.first == vehicle->id() && is_one_of(vehicles, pair.second);
        });
        if (crashed) {
            vehicle->let_go();
            derailed_.push_back(vehicle->id());
        } else {
            vehicle->fall_in(step_);
        }
    }
}

void Wrecks::decide(Collisions& collisions, NearCars& cars, Vehicles& vehicles) {
    decide_loose(collisions, vehicles);
    if (trials_.empty())
        return;
    const Touching touching = collisions.touching();
    for (bool again = true; again;) {
        again = false;
        for (Trial& trial : trials_) {
            if (trial.by != 0)
                continue;
            trial.by = hit_by(trial, touching, vehicles);
            again = again || trial.by != 0;
        }
    }
    for (const Trial& trial : trials_) {
        const auto vehicle = std::find_if(vehicles.begin(), vehicles.end(), [&](const auto& each) {
            return each->id() == trial.id;
        });
        if (trial.by != 0) {
            made_.push_back({trial.id, trial.speed, trial.by});
            cars.forget(trial.id);
            (*vehicle)->tip_over();
            continue;
        }
        collisions.forget(trial.id);
        vehicles.erase(vehicle);
        cars.put_back(trial.id);
    }
}

}  // namespace reprise::kernel

#include "scripting/run/actors.h"

#include <algorithm>
#include <cmath>

#include "world/digest.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"

namespace reprise::scripting {

namespace {

using world::to_eigen;

void set_size(Body& body, std::uint16_t model) {
    const world::VehicleModel& vehicle = world::vehicle_models()[model];
    body.front = vehicle.length - vehicle.rear_overhang;
    body.rear = vehicle.rear_overhang;
    body.half_width = vehicle.width / 2;
}

}  // namespace

Eigen::Vector3d Body::ahead() const {
    return {std::cos(yaw), std::sin(yaw), 0};
}

Eigen::Vector3d Body::centre() const {
    return position + ahead() * ((front - rear) / 2);
}

Footprint Body::footprint() const {
    return {centre(), yaw, (front + rear) / 2, half_width};
}

Body body_of(const world::TickView& tick, const world::VehicleState& vehicle) {
    Body body;
    const Eigen::Vector3d ahead = to_eigen(vehicle.orientation()) * Eigen::Vector3d::UnitX();
    body.position = to_eigen(vehicle.position());
    body.yaw = std::atan2(ahead.y(), ahead.x());
    body.speed = to_eigen(vehicle.velocity()).dot(ahead);
    body.acceleration = to_eigen(vehicle.acceleration()).dot(ahead);
    body.odometer = vehicle.odometer();
    set_size(body, vehicle.model());
    if (const auto* measured = world::find(tick.measurements(), vehicle.id())) {
        body.speed = measured->speed();
        body.acceleration = measured->acceleration();
        body.lane = measured->lane();
        body.lane_s = measured->lane_s();
        body.lane_t = measured->lane_t();
    }
    return body;
}

Body body_of(const world::CarState& car) {
    Body body;
    body.position = to_eigen(car.position());
    body.yaw = static_cast<double>(car.yaw());
    body.speed = static_cast<double>(car.speed());
    body.acceleration = static_cast<double>(car.acceleration());
    body.lane = car.lane();
    set_size(body, car.model());
    return body;
}

Body body_of(const world::PropState& prop) {
    const world::PropModel& model = world::prop_models()[prop.model()];
    const Eigen::Vector3d ahead = to_eigen(prop.orientation()) * Eigen::Vector3d::UnitX();
    Body body;
    body.position = to_eigen(prop.position());
    body.yaw = std::atan2(ahead.y(), ahead.x());
    body.speed = to_eigen(prop.velocity()).norm();
    body.half_width = model.width / 2;
    body.front = body.rear = model.length / 2;
    return body;
}

Body body_of(const world::WalkerState& walker) {
    Body body;
    body.position = to_eigen(walker.position());
    body.yaw = static_cast<double>(walker.yaw());
    body.speed = static_cast<double>(walker.speed());
    body.half_width = world::walker_models()[walker.model()].shoulder_width / 2;
    body.front = body.rear = body.half_width;
    return body;
}

std::optional<Body> body_of(const world::TickView& tick, const Actor& actor) {
    if (actor.body_at == tick.index() && actor.body_at != 0)
        return actor.body;
    if (actor.is_walker()) {
        const auto* walker = world::find(tick.walkers(), actor.id);
        return walker == nullptr ? std::nullopt : std::optional(body_of(*walker));
    }
    if (actor.is_prop()) {
        const auto* prop = world::find(tick.props(), actor.id);
        return prop == nullptr ? std::nullopt : std::optional(body_of(*prop));
    }
    if (const auto* vehicle = world::find(tick.vehicles(), actor.id))
        return body_of(tick, *vehicle);
    if (const auto* car = world::find(tick.cars(), actor.id))
        return body_of(*car);
    return std::nullopt;
}

Actor& Actors::add(Actor actor) {
    names_.insert(actor.name);
    ++present_.present;
    present_.driven += actor.is_driven() ? 1 : 0;
    actors_.push_back(std::move(actor));
    return actors_.back();
}

Actors::Obstructor Actors::obstructor(const world::TickView& tick,
                                      const Footprint& wanted,
                                      std::uint32_t self) const {
    constexpr double far_away = 50;  // [m] no two models are that long
    for (const Actor& actor : actors_) {
        // Who was put elsewhere since the tick is there already.
        const bool here =
            actor.presence == Actor::Presence::here && actor.displaced_at != tick.index();
        if (actor.id == self || actor.presence == Actor::Presence::gone || actor.is_leaving ||
            !(here || actor.p_world_asked) ||
            ((here ? actor.position : *actor.p_world_asked) - wanted.centre).norm() > far_away)
            continue;
        const std::optional<Body> body = here ? body_of(tick, actor) : std::nullopt;
        const double depth = overlap(wanted, body ? body->footprint() : actor.asked);
        if (depth > 0)
            return {&actor, depth};
    }
    return {};
}

std::size_t Actors::count_near(const Eigen::Vector3d& p_world, double radius, bool props) const {
    const auto near = [&](const Actor& actor) {
        if (actor.is_walker() || actor.is_prop() != props ||
            actor.presence == Actor::Presence::gone)
            return false;
        const bool here = actor.presence == Actor::Presence::here;
        return (here || actor.p_world_asked) &&
               ((here ? actor.position : *actor.p_world_asked) - p_world).norm() <= radius;
    };
    return static_cast<std::size_t>(std::count_if(actors_.begin(), actors_.end(), near));
}

const Actor* Actors::find(const std::string& name) const {
    const auto found = std::find_if(
        actors_.begin(), actors_.end(), [&](const Actor& actor) { return actor.name == name; });
    return found == actors_.end() ? nullptr : &*found;
}

std::string Actors::free_name(const std::string& model) {
    std::string name = model;
    int& number = next_number_.try_emplace(model, 2).first->second;
    for (; has_name(name); ++number)
        name = model + "_" + std::to_string(number);
    return name;
}

void Actors::observe(const world::TickView& tick, double step, const Watch& watch) {
    for (Actor& actor : actors_) {
        if (actor.presence == Actor::Presence::gone)
            continue;
        const auto body = body_of(tick, actor);
        if (!body) {
            if (actor.presence == Actor::Presence::here)
                leave(actor, tick.index());
            continue;
        }
        const double before = actor.travelled;
        if (actor.presence == Actor::Presence::here)
            actor.travelled += std::abs(body->speed) * step;
        if (body->odometer)
            actor.travelled = *body->odometer;
        actor.presence = Actor::Presence::here;
        actor.position = body->position;
        actor.body = *body;
        actor.body_at = tick.index();
        watch(actor, *body, actor.travelled - before);
    }
    observe_contacts(tick);
}

void Actors::leave(Actor& actor, std::uint64_t tick) {
    actor.presence = Actor::Presence::gone;
    actor.gone_at = tick;
    --present_.present;
    present_.driven -= actor.is_driven() ? 1 : 0;
}

void Actors::observe_contacts(const world::TickView& tick) {
    const auto* events = tick.tick->events();
    if (events == nullptr)
        return;
    for (const world::Event* event : *events) {
        if (event->kind() != world::EventKind::collision)
            continue;
        touch(tick, event->actor(), event->other());
        touch(tick, event->other(), event->actor());
    }
}

void Actors::touch(const world::TickView& tick, std::uint32_t actor, std::uint32_t other) {
    if (actor == 0 || actor > actors_.size())
        return;
    Contacts& contacts = at(actor).contacts;
    if (other == 0) {
        contacts.fixed = true;
        return;
    }
    const bool walker = other <= actors_.size() ? at(other).is_walker()
                                                : world::find(tick.walkers(), other) != nullptr;
    const bool prop = other <= actors_.size() && at(other).is_prop();
    (walker ? contacts.walker : prop ? contacts.prop : contacts.vehicle) = true;
    if (!walker && !prop && !at(actor).is_walker())
        at(actor).follows_until = 0;  // a crash takes it from its trajectory
    contacts.others.insert(other);
}

void Actors::digest(world::Hasher& hasher) const {
    hasher.add(next_id());
    for (const Actor& actor : actors_) {
        hasher.add_text(actor.name);
        hasher.add(actor.driver);
        hasher.add(actor.model);
        hasher.add(actor.asked_at);
        hasher.add(actor.presence);
        hasher.add(actor.gone_at);
        hasher.add(actor.follows_until);
        hasher.add(actor.displaced_at);
        hasher.add(actor.travelled);
        hasher.add(world::to_vec3(actor.position));
        hasher.add(
            static_cast<std::uint8_t>(actor.is_leaving + 2 * actor.keeps_lane + 4 * actor.walks));
        hasher.add(static_cast<std::uint8_t>(actor.contacts.vehicle));
        hasher.add(static_cast<std::uint8_t>(actor.contacts.walker));
        hasher.add(static_cast<std::uint8_t>(actor.contacts.fixed));
        if (actor.contacts.prop)
            hasher.add(actor.contacts.prop);
        hasher.add(static_cast<std::uint64_t>(actor.contacts.others.size()));
        for (const std::uint32_t other : actor.contacts.others)
            hasher.add(other);
        hasher.add(
            static_cast<std::uint8_t>(actor.lights.ran_red() + 2 * actor.lights.is_undecided()));
        hasher.add(actor.route ? actor.route->share() : -1.0);
    }
}

}  // namespace reprise::scripting

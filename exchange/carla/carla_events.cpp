#include "exchange/carla/carla_events.h"

#include <algorithm>

#include "world/tick.h"

namespace reprise::exchange {

namespace {

using Eigen::Vector3d;
using world::rounded;

constexpr double one_contact = 0.5;  // [s] without a collision of two end their contact

template <typename Items, typename Key>
const typename Items::value_type* find_item(const Items& items, std::uint32_t id, Key key) {
    const auto found =
        std::find_if(items.begin(), items.end(), [&](const auto& item) { return key(item) == id; });
    return found == items.end() ? nullptr : &*found;
}

bool is_hero(const CarlaActor& actor) {
    const auto role = actor.attributes.find("role_name");
    return role != actor.attributes.end() && role->second == "hero";
}

}  // namespace

world::Vec3 on_grid(const Vector3d& p) {
    return {rounded(p.x(), per_metre), rounded(p.y(), per_metre), rounded(p.z(), per_metre)};
}

void CarlaEvents::tell(world::EventKind kind,
                       std::uint32_t actor,
                       const Vector3d& at,
                       std::string text) {
    world::EventT event;
    event.kind = kind;
    event.actor = actor;
    event.position = on_grid(at);
    event.text = std::move(text);
    events_.push_back(std::move(event));
}

void CarlaEvents::add_collision(const CarlaCollision& collision, const CarlaFrame& frame) {
    std::uint32_t actor = survey_->roles.count(collision.actor) > 0 ? collision.actor : 0;
    std::uint32_t other = survey_->roles.count(collision.other) > 0 ? collision.other : 0;
    if (actor == 0)
        std::swap(actor, other);
    if (actor == 0)
        return;
    const auto [contact, is_new] =
        contacts_.try_emplace({std::min(actor, other), std::max(actor, other)}, frame.elapsed);
    const bool goes_on = !is_new && frame.elapsed - contact->second < one_contact;
    contact->second = frame.elapsed;
    const CarlaPose* pose =
        find_item(frame.poses, actor, [](const CarlaPose& item) { return item.actor; });
    if (goes_on || pose == nullptr)
        return;
    tell(world::EventKind::collision, actor, body_of(*pose, *survey_, offset_).position, "");
    events_.back().other = other;
}

void CarlaEvents::read(const CarlaFrame& frame, const std::vector<Body>& last) {
    for (const CarlaActor& actor : frame.added)
        if (survey_->roles.count(actor.pose.actor) > 0)
            tell(world::EventKind::spawned,
                 actor.pose.actor,
                 body_of(actor.pose, *survey_, offset_).position,
                 survey_->hero == actor.pose.actor && is_hero(actor) ? "hero" : actor.blueprint);
    for (const CarlaCollision& collision : frame.collisions)
        add_collision(collision, frame);
    for (const std::uint32_t id : frame.removed) {
        if (survey_->roles.count(id) == 0)
            continue;
        const Body* body = find_item(last, id, [](const Body& item) { return item.id; });
        tell(world::EventKind::despawned,
             id,
             body == nullptr ? Vector3d(Vector3d::Zero()) : body->position,
             "");
    }
}

}  // namespace reprise::exchange

// The tick of all who walk: the order in which things are done, and what is written. Who there is:
// crowd_people.cpp; ways: crowd_ways.cpp; steps: crowd_steps.cpp.
#include "walkers/crowd.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "walkers/things.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::walkers {

namespace {

using ground::Surface;

/// What everybody keeps, in one piece: a digest of many small ones costs more.
struct WalkerDigest {
    std::uint32_t id;
    std::uint32_t polygon;
    std::array<double, 9> numbers;
    std::array<std::uint64_t, 9> counts;
};

static_assert(sizeof(WalkerDigest) == 152, "no padding");

constexpr std::uint64_t meets_bit = std::uint64_t{1} << 32;

}  // namespace

Crowd::Crowd(const world::EpisodeT& episode,
             const world::TownT& town,
             const world::LaneMap& lanes,
             WalkingGround& ground)
    : episode_(&episode),
      town_(&town),
      lanes_(&lanes),
      ground_(&ground),
      step_(world::seconds(1, episode.step_ns)),
      traffic_(town, lanes),
      lights_(town) {
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (town.lanes[i].kind != world::LaneKind::sidewalk)
            continue;
        sidewalks_.push_back(i);
        ends_.push_back((ends_.empty() ? 0 : ends_.back()) + town.lanes[i].length);
    }
}

const WalkMap& Crowd::map_of(const Person& person) {
    return person.jaywalks ? ground_->streets() : ground_->pavement();
}

const Crowd::Walker* Crowd::find(std::uint32_t id) const {
    const auto at = std::lower_bound(
        walkers_.begin(), walkers_.end(), id, [](const Walker& one, std::uint32_t wanted) {
            return one.id < wanted;
        });
    return at != walkers_.end() && at->id == id ? &*at : nullptr;
}

void Crowd::advance(const world::TickView& last, OnFoot& next) {
    const std::uint64_t tick = next.tick;
    plans_ = 0;

    // Who was hit, who leaves, who comes.
    users_.look(last, step_);
    lights_.look(last);
    traffic_.look(users_.all());
    threats_.look(users_.all());
    lay_down(last, tick);
    remove_hit_and_lost(next);
    fill_up(last, next);

    // Everybody as the others see him.
    neighbours_.clear();
    for (const world::WalkerState& walker : next.walkers)
        neighbours_.add({{walker.position().x(), walker.position().y()},
                         static_cast<double>(walker.speed()) *
                             world::ahead_of(static_cast<double>(walker.yaw())),
                         world::walker_models()[walker.model()].shoulder_width / 2,
                         walker.id()},
                        false);
    people_.clear();
    on_road_.clear();
    for (Walker& walker : walkers_) {
        const Eigen::Vector2d place = walker.place.position.head<2>();
        walker.body =
            neighbours_.add({place, walker.velocity, walker.person.radius, walker.id}, false);
        people_.add(place);
        walker.on_road = map_of(walker.person).surface(walker.place) != Surface::sidewalk;
        if (walker.on_road)
            on_road_.add(place);
    }
    people_.sort();
    on_road_.sort();
    add_things(last, users_.all(), on_road_, people_, neighbours_);
    neighbours_.sort();

    // Where to, around whom, and the step.
    for (Walker& walker : walkers_) {
        walker.body = neighbours_.index_of(walker.body);
        want(walker, tick);
    }
    look_at_stopped();
    for (Walker& walker : walkers_) {
        make_way(walker);
        step_back(walker);
        avoid(walker);
    }
    flee();
    for (Walker& walker : walkers_) {
        step(walker, tick);
        watch(walker, tick);
    }
    for (const Walker& walker : walkers_)
        write(walker, next);
}

void Crowd::write(const Walker& walker, OnFoot& next) const {
    using world::rounded;
    const Eigen::Vector3d& p = walker.place.position;
    next.walkers.emplace_back(
        world::Vec3(rounded(p.x(), 1024), rounded(p.y(), 1024), rounded(p.z(), 1024)),
        static_cast<float>(rounded(walker.yaw, 8192)),
        static_cast<float>(rounded(walker.velocity.norm(), 1024)),
        static_cast<float>(std::floor(walker.phase * 8192) / 8192),
        walker.id,
        walker.person.model,
        walker.down_until != 0,
        std::uint8_t{0},
        walker.person.look);
}

double* Crowd::number(std::uint32_t id, std::string_view field) {
    const Walker* found = find(id);
    if (found == nullptr)
        return nullptr;
    Walker& walker = walkers_[static_cast<std::size_t>(found - walkers_.data())];
    return field == "position.x"   ? &walker.place.position.x()
           : field == "position.y" ? &walker.place.position.y()
           : field == "position.z" ? &walker.place.position.z()
           : field == "yaw"        ? &walker.yaw
           : field == "speed"      ? &walker.velocity.x()
           : field == "phase"      ? &walker.phase
                                   : nullptr;
}

void Crowd::add_to(world::Hasher& hasher) const {
    hasher.add(next_id_);
    hasher.add(tries_);
    lights_.add_to(hasher);
    if (!walkers_.empty())
        users_.add_to(hasher);
    for (const Walker& walker : walkers_) {
        const Eigen::Vector3d& p = walker.place.position;
        hasher.add(
            WalkerDigest{walker.id,
                         walker.place.polygon,
                         {p.x(),
                          p.y(),
                          p.z(),
                          walker.velocity.x(),
                          walker.velocity.y(),
                          walker.yaw,
                          walker.phase,
                          walker.was_at.x(),
                          walker.was_at.y()},
                         {walker.way.size(),
                          walker.corner,
                          4 * walker.gate + (walker.entered ? 2U : 0U) + (walker.gave_up ? 1U : 0U),
                          walker.waited,
                          walker.stuck + (walker.meets ? meets_bit : 0),
                          walker.pause_until,
                          walker.was_at_tick,
                          walker.down_until,
                          walker.draws}});
        if (walker.lets != 0) {
            hasher.add(walker.lets);
            hasher.add(walker.let_for);
        }
        if (!walker.way.empty())
            hasher.add(world::to_vec3(walker.way.back().position));
    }
}

}  // namespace reprise::walkers

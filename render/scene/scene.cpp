// What it must do: hold everybody at a tick as triangles that rays can find, beside the town.
// What it assumes: ticks are sorted by id.
// How it goes: a tree of who is there, built anew for every tick (history-free, and cheaper than
//   refitting).
// What it keeps: nothing of the last tick but what Embree need not be told again.
#include "render/scene/scene.h"

#include <algorithm>

#include <embree3/rtcore.h>

namespace reprise::render {

namespace {

constexpr std::uint32_t first_mount_bit = 2;
constexpr std::size_t mount_bits = 30;

}  // namespace

Scene::~Scene() {
    if (standing_ != nullptr)
        rtcReleaseScene(standing_);
}

/// The town without these instances, which keep their numbers. Made anew when they change.
void Scene::take_down(std::vector<std::size_t> broken) {
    if (broken == broken_)
        return;
    broken_ = std::move(broken);
    if (standing_ != nullptr)
        rtcReleaseScene(standing_);
    standing_ = nullptr;
    portable_standing_.reset();
    if (broken_.empty())
        return;
    std::vector<Instance> standing(town_.instances().begin(), town_.instances().end());
    for (const std::size_t index : broken_)
        standing[index].mask = 0;
    if (town_.portable_tracer() != nullptr)
        portable_standing_.emplace(standing);
    else
        standing_ = town_.tree_of(standing);
}

std::uint32_t Scene::mask_hiding(std::uint32_t actor) const {
    const auto mount = std::find(mounts_.begin(), mounts_.end(), actor);
    if (actor == 0 || mount == mounts_.end())
        return 0xffffffffu;
    const auto index = static_cast<std::size_t>(mount - mounts_.begin()) % mount_bits;
    return ~(1u << (first_mount_bit + index));
}

void Scene::hide_mounts() {
    for (Instance& instance : moving_)
        if (std::find(mounts_.begin(), mounts_.end(), instance.actor) != mounts_.end())
            instance.mask = ~mask_hiding(instance.actor);
}

void Scene::commit(const Ball& ball) {
    if (town_.portable_tracer() != nullptr) {
        portable_tracer_.emplace(
            moving_, portable_standing_ ? &*portable_standing_ : town_.portable_tracer());
        return;
    }
    if (!tree_)
        tree_.emplace(town_);
    tree_->hold(moving_, ball);
    crowd_.fill(true);
}

void Scene::map_crowd() {
    crowd_.fill(false);
    for (const Instance& one : moving_)
        crowd_.add(one.pose.translation(), reach_of(one));
}

}  // namespace reprise::render

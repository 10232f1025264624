#include "render/scene/tick_tree.h"

#include <algorithm>

#include <embree3/rtcore.h>

namespace reprise::render {

double reach_of(const Instance& instance) {
    // Frobenius' norm: no stretch of the pose is larger.
    return instance.pose.linear().norm() * instance.prototype->radius;
}

bool Ball::touches(const Instance& instance) const {
    const double reach = radius + reach_of(instance);
    return (instance.pose.translation() - middle).squaredNorm() <= reach * reach;
}

TickTree::TickTree(const TownScene& town) : town_(town), tree_(town.new_tree()) {}

TickTree::~TickTree() {
    rtcReleaseScene(tree_);
}

void TickTree::forget(unsigned id) {
    if (told_[id].prototype != nullptr)
        rtcDetachGeometry(tree_, id);
    told_[id].prototype = nullptr;
}

void TickTree::tell(const Instance& instance, unsigned id) {
    Told& told = told_[id];
    if (told.prototype != instance.prototype || told.mask != instance.mask) {
        forget(id);
        town_.attach(tree_, instance, id);
    } else if (told.pose != instance.pose.matrix()) {
        RTCGeometry geometry = rtcGetGeometry(tree_, id);
        set_pose(geometry, instance);
        rtcCommitGeometry(geometry);
    }
    told = {instance.prototype, instance.mask, instance.pose.matrix()};
}

void TickTree::hold(std::span<const Instance> instances, const Ball& ball) {
    told_.resize(std::max(told_.size(), instances.size()));
    for (unsigned id = 0; id < told_.size(); ++id)
        if (id < instances.size() && ball.touches(instances[id]))
            tell(instances[id], id);
        else
            forget(id);
    rtcCommitScene(tree_);
    town_.check();
}

}  // namespace reprise::render

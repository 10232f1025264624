#include "render/scene/motion.h"

#include <map>

namespace reprise::render {

namespace {

constexpr double jump = 4;  // [m] between two ticks: nobody drives 80 m/s

Motion motion_between(const Eigen::Affine3d& here, const Eigen::Affine3d& there) {
    Motion motion{here.translation(), there.translation(), Eigen::Quaterniond::Identity(), true};
    if ((motion.to - motion.from).norm() > jump)
        return {};
    // Both are stretched alike, so that what is between them is a turn; up to rounding.
    const Eigen::Matrix3d turn = there.linear() * here.linear().inverse();
    motion.turn = Eigen::Quaterniond(turn).normalized();
    motion.moves = !turn.isIdentity(1e-12) || motion.to != motion.from;
    return motion;
}

}  // namespace

std::vector<const Instance*> partners(const Scene& scene, const Scene& other) {
    std::map<std::uint32_t, std::vector<const Instance*>> parts;
    for (const Instance& instance : other.moving())
        parts[instance.actor].push_back(&instance);
    std::map<std::uint32_t, std::size_t> taken;
    std::vector<const Instance*> found;
    for (const Instance& instance : scene.moving()) {
        const std::size_t number = taken[instance.actor]++;
        const auto those = parts.find(instance.actor);
        const Instance* partner = those == parts.end() || number >= those->second.size()
                                      ? nullptr
                                      : those->second[number];
        found.push_back(partner != nullptr && partner->prototype == instance.prototype ? partner
                                                                                       : nullptr);
    }
    return found;
}

Eigen::Affine3d Motion::at(double share) const {
    if (!moves)
        return Eigen::Affine3d::Identity();
    const Eigen::Quaterniond turned = Eigen::Quaterniond::Identity().slerp(share, turn);
    return Eigen::Translation3d(from + share * (to - from)) * Eigen::Affine3d(turned) *
           Eigen::Translation3d(-from);
}

std::vector<Motion> motions(const Scene& scene, const Scene& other) {
    const std::vector<const Instance*> there = partners(scene, other);
    std::vector<Motion> found;
    for (std::size_t i = 0; i < there.size(); ++i)
        found.push_back(there[i] == nullptr
                            ? Motion()
                            : motion_between(scene.moving()[i].pose, there[i]->pose));
    return found;
}

}  // namespace reprise::render

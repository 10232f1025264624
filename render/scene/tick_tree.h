#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "render/scene/town_scene.h"

namespace reprise::render {

/// A part of the scene that rays stay in. [m]
struct Ball {
    Eigen::Vector3d middle{0, 0, 0};
    double radius = std::numeric_limits<double>::infinity();

    bool touches(const Instance& instance) const;
};

/// [m] from its origin to where it surely ends.
double reach_of(const Instance& instance);

/// Embree's tree of who is there, at one time after the other: for rays that stay in its ball that
/// of TownScene::tree_of, whatever it was before. What stays as it was need not be told again; the
/// tree is built anew.
class TickTree {
  public:
    /// Of nobody yet. The town, which is not in it, must outlive this, and not be portable.
    explicit TickTree(const TownScene& town);
    ~TickTree();
    TickTree(const TickTree&) = delete;
    TickTree& operator=(const TickTree&) = delete;

    /// Their numbers are Embree's ids.
    void hold(std::span<const Instance> instances, const Ball& ball);

    RTCSceneTy* handle() const { return tree_; }

  private:
    /// What Embree was told; without a prototype: nothing.
    struct Told {
        const Prototype* prototype = nullptr;
        std::uint32_t mask = 0;
        Eigen::Matrix4d pose;
    };

    void tell(const Instance& instance, unsigned id);
    void forget(unsigned id);

    const TownScene& town_;
    RTCSceneTy* tree_;
    std::vector<Told> told_;  ///< by id
};

}  // namespace reprise::render

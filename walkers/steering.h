#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <Eigen/Core>

namespace reprise::walkers {

/// Something round that others keep away from, in plan.
struct Body {
    Eigen::Vector2d place{0, 0};
    Eigen::Vector2d velocity{0, 0};
    double radius = 0;
    std::uint32_t id = 0;
};

/// Who walks where others walk chooses a velocity that comes near the wanted one and meets nobody
/// soon: DetourCrowd's reciprocal velocity obstacles, sampled. A pure function of its arguments.
class Steering {
  public:
    Steering();
    ~Steering();
    Steering(Steering&&) noexcept;
    Steering& operator=(Steering&&) noexcept;

    /// [m/s]; `around`: the nearest first, six at most count. 2 us.
    Eigen::Vector2d choose(const Body& self,
                           const Eigen::Vector2d& wanted,
                           std::span<const Body> around);

    static constexpr std::size_t most_around = 6;

  private:
    struct Query;
    std::unique_ptr<Query> query_;
};

/// True when DetourCrowd's compiled code turns a direction to the same bits as this program's own
/// sine and cosine do: then both use one libm. 10 us.
bool detour_uses_our_maths();

}  // namespace reprise::walkers

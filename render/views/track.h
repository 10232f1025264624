#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "world/models/viewpoint.h"

namespace reprise::render {

/// Where an actor was, tick by tick, as long as it was there.
struct Track {
    std::uint32_t actor = 0;
    world::Extent extent;
    world::Viewpoint eye;                  ///< where it looks from
    double step = 0.05;                    ///< [s] a tick
    std::uint64_t first = 0;               ///< tick of poses[0]
    std::vector<Eigen::Isometry3d> poses;  ///< world; of consecutive ticks, at least one

    std::uint64_t last() const { return first + poses.size() - 1; }

    /// Of a tick; before and after, the first and the last one.
    std::size_t index(std::uint64_t tick) const;
};

/// An actor without the jerks, as somebody sees it who follows it: mean over the ticks around,
/// those to come as well as those gone by, so that nothing lags behind. No bank.
struct Heading {
    Eigen::Vector3d position;  ///< world
    double yaw = 0;            ///< [rad]
    double pitch = 0;          ///< [rad] nose up

    /// Takes the followed frame to the world.
    Eigen::Isometry3d pose() const;
};

/// The means of a track. Where the actor jumped, as when it was put somewhere else, nothing is
/// taken from beyond the jump; and at the ends of the track nothing is smoothed, so that the actor
/// stays where it is in the picture.
class SmoothTrack {
  public:
    explicit SmoothTrack(Track track);

    const Track& track() const { return track_; }

    Heading at(std::uint64_t tick) const;

    /// The indices around `index` on its side of all jumps; at most `reach` away, and as many
    /// before as behind when `even`.
    struct Span {
        std::size_t first;
        std::size_t last;
    };

    Span around(std::size_t index, std::size_t reach, bool even) const;

    /// How many ticks this is. [s]
    std::size_t ticks(double seconds) const;

  private:
    double mean_of(std::size_t index, double deviation, const std::vector<double>& values) const;

    Track track_;
    std::vector<std::size_t> piece_first_;  ///< of each index: where its piece begins ...
    std::vector<std::size_t> piece_last_;   ///< ... and ends
    std::vector<double> x_, y_, z_;
    std::vector<double> yaw_;  ///< without the steps of a whole turn
    std::vector<double> pitch_;
};

}  // namespace reprise::render

#pragma once

#include <cstdint>
#include <vector>

#include "towns/bridges/pieces.h"
#include "towns/bridges/road_chains.h"
#include "towns/maps/map_shapes.h"
#include "world/town.h"

namespace reprise::towns {

/// The bridges and tunnels of a map: what was drawn as several ways is one span.
class Spans {
  public:
    /// `ways` have a layer, and must outlive the spans.
    explicit Spans(const std::vector<MapShape>& ways);

    /// The span that a track is on at one of its places; none: the ground.
    std::uint32_t at(const Eigen::Vector2d& place,
                     const Eigen::Vector2d& direction,
                     const Track& track) const;

    int layer(std::uint32_t span) const { return span == world::none ? 0 : layers_[span]; }

    std::size_t size() const { return layers_.size(); }

  private:
    void join(const std::vector<MapShape>& ways);

    std::vector<int> layers_;
    std::vector<std::uint32_t> span_of_way_;
    std::vector<Piece> pieces_;  ///< owned by spans
    world::BoxGrid by_place_;
};

}  // namespace reprise::towns

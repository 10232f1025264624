#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "world/common_generated.h"

namespace reprise::exchange {

struct Geodetic {
    double latitude_deg = 0;
    double longitude_deg = 0;
};

/// What netconvert added to the coordinates of the map that the network was made from. [m]; 0, 0
/// when the network does not say.
Eigen::Vector2d net_offset(const std::string& network);

/// Takes a town's coordinates to the globe, as its SUMO network says in <location>.
class GeoOrigin {
  public:
    /// Nothing when the network was made up and lies nowhere.
    static std::optional<GeoOrigin> of(const std::string& network);

    ~GeoOrigin();
    GeoOrigin(GeoOrigin&&) noexcept;
    GeoOrigin& operator=(GeoOrigin&&) noexcept;

    /// WGS 84.
    Geodetic at(const world::Vec3& position) const;

  private:
    struct Projection;
    explicit GeoOrigin(std::unique_ptr<Projection> projection);
    std::unique_ptr<Projection> projection_;
};

}  // namespace reprise::exchange

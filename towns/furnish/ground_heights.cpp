#include "towns/furnish/ground_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/ground_probe.h"

namespace reprise::towns {

namespace {

constexpr double level_enough = 1e-3;  ///< [m] between the highest and the lowest lane
constexpr double spacing = 2;          ///< [m] half a cell of the terrain

bool lies_level(const world::TownT& town) {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();
    for (const world::LaneT& lane : town.lanes)
        for (const world::Vec3& p : lane.centre) {
            low = std::min(low, p.z());
            high = std::max(high, p.z());
        }
    return high - low < level_enough;
}

}  // namespace

struct GroundHeights::Hills {
    explicit Hills(const world::TownT& town) : ground(ground::build_ground(town)), probe(ground) {}

    ground::GroundMesh ground;
    ground::GroundProbe probe;
};

GroundHeights::GroundHeights(const world::TownT& town)
    : hills_(lies_level(town) ? nullptr : std::make_unique<const Hills>(town)) {}

GroundHeights::~GroundHeights() = default;

std::optional<double> GroundHeights::at(const Eigen::Vector2d& p, double near) const {
    if (is_level())
        return near;
    const auto hit = hills_->probe.nearest({p.x(), p.y(), near});
    return hit ? std::optional(hit->z) : std::nullopt;
}

std::optional<GroundHeights::Span> GroundHeights::under(const Footprint& footprint,
                                                        double near) const {
    if (is_level())
        return Span{near, near};
    const world::Loop corner = corners(footprint);
    const Eigen::Vector2d along = corner[1] - corner[0];
    const Eigen::Vector2d across = corner[3] - corner[0];
    const int columns = 1 + static_cast<int>(footprint.length / spacing);
    const int rows = 1 + static_cast<int>(footprint.width / spacing);
    Span span{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
    for (int x = 0; x <= columns; ++x)
        for (int y = 0; y <= rows; ++y) {
            const auto z = at(corner[0] + along * x / columns + across * y / rows, near);
            if (!z)
                return std::nullopt;
            span = {std::min(span.low, *z), std::max(span.high, *z)};
        }
    return span;
}

}  // namespace reprise::towns

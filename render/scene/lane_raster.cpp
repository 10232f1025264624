#include "render/scene/lane_raster.h"

#include <algorithm>

#include "render/shapes/fast_math.h"
#include "world/town.h"

namespace reprise::render {

namespace {

constexpr float units = 60;  // of a stored distance, in a metre
constexpr float margin = 2;  // [m] around the town

Eigen::Vector2f flat(const world::Vec3& position, const Eigen::Vector3d& origin) {
    return Eigen::Vector2d(position.x() - origin.x(), position.y() - origin.y()).cast<float>();
}

}  // namespace

LaneRaster::LaneRaster(const world::TownT& town, const Eigen::Vector3d& origin) {
    low_ = flat(town.low, origin) - Eigen::Vector2f::Constant(margin);
    const Eigen::Vector2f size = flat(town.high, origin) + Eigen::Vector2f::Constant(margin) - low_;
    // At most 64 million cells: 64 MB.
    while (size.x() * size.y() / (cell_ * cell_) > 64e6F)
        cell_ *= 2;
    columns_ = std::max(2, static_cast<int>(size.x() / cell_) + 2);
    rows_ = std::max(2, static_cast<int>(size.y() / cell_) + 2);
    distances_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 240);
    for (const world::LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i)
            stamp(flat(lane.centre[i], origin),
                  flat(lane.centre[i + 1], origin),
                  static_cast<float>(lane.width) * 0.5F);
    }
}

void LaneRaster::stamp(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float half_width) {
    const float reach = half_width + 2 * cell_;
    const Eigen::Vector2f least = (from.cwiseMin(to) - low_).array() - reach;
    const Eigen::Vector2f most = (from.cwiseMax(to) - low_).array() + reach;
    const int first_row = std::max(0, floor_int(least.y() / cell_));
    const int last_row = std::min(rows_ - 1, floor_int(most.y() / cell_) + 1);
    const int first_column = std::max(0, floor_int(least.x() / cell_));
    const int last_column = std::min(columns_ - 1, floor_int(most.x() / cell_) + 1);
    const Eigen::Vector2f along = to - from;
    const float squared = std::max(along.squaredNorm(), 1e-6F);
    for (int row = first_row; row <= last_row; ++row) {
        for (int column = first_column; column <= last_column; ++column) {
            const Eigen::Vector2f place =
                low_ + cell_ * Eigen::Vector2f(static_cast<float>(column), static_cast<float>(row));
            const float share = clamp01((place - from).dot(along) / squared);
            const float distance = (place - from - share * along).norm();
            if (distance > reach)
                continue;
            std::uint8_t& stored = distances_[static_cast<std::size_t>(row * columns_ + column)];
            stored =
                std::min(stored, static_cast<std::uint8_t>(std::min(239.0F, distance * units)));
        }
    }
}

float LaneRaster::distance(float x, float y) const {
    const float fx = (x - low_.x()) / cell_;
    const float fy = (y - low_.y()) / cell_;
    if (!(fx >= 0 && fy >= 0))
        return 4;
    const int column = floor_int(fx);
    const int row = floor_int(fy);
    if (column + 1 >= columns_ || row + 1 >= rows_)
        return 4;
    const auto at = [&](int i, int j) {
        return static_cast<float>(distances_[static_cast<std::size_t>(j * columns_ + i)]);
    };
    const float share_x = fx - static_cast<float>(column);
    const float share_y = fy - static_cast<float>(row);
    return mix(mix(at(column, row), at(column + 1, row), share_x),
               mix(at(column, row + 1), at(column + 1, row + 1), share_x),
               share_y) /
           units;
}

}  // namespace reprise::render

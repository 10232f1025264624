#include "ground/mesh/surface_height.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "ground/mesh/ribbon.h"
#include "world/frames.h"

namespace reprise::ground {

namespace {

constexpr double flatness = 0.001;  ///< [m]

bool is_level(const std::vector<Eigen::Vector3d>& points) {
    double low = points[0].z();
    double high = low;
    for (const Eigen::Vector3d& p : points) {
        low = std::min(low, p.z());
        high = std::max(high, p.z());
    }
    return high - low <= flatness;
}

void sample(const std::vector<world::Vec3>& line, std::vector<Eigen::Vector3d>& samples) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector3d start = world::to_eigen(line[i]);
        const Eigen::Vector3d along = world::to_eigen(line[i + 1]) - start;
        const int count = 1 + static_cast<int>(along.head<2>().norm());
        for (int k = 0; k < count; ++k)
            samples.push_back(start + along * (static_cast<double>(k) / count));
    }
    if (!line.empty())
        samples.push_back(world::to_eigen(line.back()));
}

/// Slope of the plane through `base` that fits best. Points on one line say nothing about the slope
/// across it: the small ridge makes that 0.
Eigen::Vector2d fitted_slope(const std::vector<Eigen::Vector3d>& points,
                             const Eigen::Vector3d& base) {
    Eigen::Matrix2d normal = 1e-4 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const Eigen::Vector3d& point : points) {
        const Eigen::Vector3d offset = point - base;
        normal += offset.head<2>() * offset.head<2>().transpose();
        right += offset.head<2>() * offset.z();
    }
    return normal.inverse() * right;
}

}  // namespace

SurfaceHeight::SurfaceHeight(const std::vector<std::vector<world::Vec3>>& lines) {
    for (const std::vector<world::Vec3>& line : lines)
        sample(line, residues_);
    if (residues_.empty())
        return;
    // A level surface stays level to the last bit.
    base_ = residues_[0];
    if (is_level(residues_))
        return;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& point : residues_)
        sum += point;
    base_ = sum / static_cast<double>(residues_.size());
    slope_ = fitted_slope(residues_, base_);
    for (Eigen::Vector3d& point : residues_)
        point.z() -= base_.z() + slope_.dot((point - base_).head<2>());
    is_plane_ = std::all_of(residues_.begin(), residues_.end(), [](const Eigen::Vector3d& point) {
        return std::abs(point.z()) <= flatness;
    });
}

SurfaceHeight SurfaceHeight::along(std::vector<Eigen::Vector3d> line) {
    SurfaceHeight height;
    height.is_plane_ = is_level(line);
    height.base_ = line[0];
    height.line_ = std::move(line);
    return height;
}

double SurfaceHeight::at(const Eigen::Vector2d& p) const {
    if (!is_plane_ && !line_.empty())
        return height_along(line_, p);
    const double plane = base_.z() + slope_.dot(p - base_.head<2>());
    if (is_plane_)
        return plane;
    double weights = 0;
    double sum = 0;
    for (const Eigen::Vector3d& residue : residues_) {
        const double squared_distance = (residue.head<2>() - p).squaredNorm() + 1e-4;
        const double weight = 1 / (squared_distance * squared_distance);
        weights += weight;
        sum += weight * residue.z();
    }
    return plane + sum / weights;
}

}  // namespace reprise::ground

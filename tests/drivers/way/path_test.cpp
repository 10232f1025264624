#include "drivers/way/path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "world/random.h"

namespace reprise::drivers {
namespace {

/// To and fro, 30 m aside each time, so that parts far apart along it are near each other.
Path serpentine() {
    std::vector<Eigen::Vector3d> corners;
    for (int i = 0; i <= 2000; ++i) {
        const double along = 0.31 * i;
        corners.emplace_back(40 * std::sin(along / 30), along / 4, 0);
    }
    Path path;
    path.append(corners, 14);
    path.finish({});
    path.drop_before(20);
    return path;
}

/// Of every sample.
double nearest_squared(const Path& path, const Eigen::Vector2d& p, double from, double reach) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = path.index(from); i <= path.index(from + reach); ++i)
        least = std::min(least, (path.points()[i].position.head<2>() - p).squaredNorm());
    return least;
}

TEST(Path, ProjectsToTheNearestOfAllItsPlaces) {
    const Path path = serpentine();
    const auto drawn = [](std::uint64_t item, std::uint64_t which) {
        return world::draw(7, which, world::Purpose::place, item);
    };
    for (std::uint64_t item = 0; item < 2000; ++item) {
        const Eigen::Vector2d p(200 * drawn(item, 0) - 100, 240 * drawn(item, 1) - 40);
        const double from = path.start() + drawn(item, 2) * (path.end() - path.start());
        const double reach = 300 * drawn(item, 3);
        const double s = path.project({p.x(), p.y(), 0}, from, reach);
        EXPECT_GE(s, from);
        EXPECT_LE(s, from + reach + Path::spacing);
        // Between samples it is nearer by less than their distance.
        const double nearest = std::sqrt(nearest_squared(path, p, from, reach));
        const double found = (path.at(s).position.head<2>() - p).norm();
        EXPECT_LE(found, nearest + 1e-6 + (s == from ? Path::spacing : 0)) << item;
        EXPECT_GE(found, nearest - Path::spacing) << item;
    }
}

}  // namespace
}  // namespace reprise::drivers

#include "drivers/way/lane_lines.h"

#include <algorithm>

#include "world/frames.h"

namespace reprise::drivers {

std::vector<Eigen::Vector3d> part_of(const world::LaneT& lane, double from, double to) {
    std::vector<Eigen::Vector3d> line{world::point_at(lane, from).position};
    double s = 0;
    for (std::size_t i = 0; i < lane.centre.size(); ++i) {
        const Eigen::Vector3d point = world::to_eigen(lane.centre[i]);
        if (i > 0)
            s += (point - world::to_eigen(lane.centre[i - 1])).norm();
        if (s > from + 1e-6 && s < to - 1e-6)
            line.push_back(point);
    }
    line.push_back(world::point_at(lane, to).position);
    return line;
}

std::vector<Eigen::Vector3d> change_line(const world::LaneT& here,
                                         const world::LaneT& there,
                                         double begin,
                                         double length) {
    std::vector<Eigen::Vector3d> line;
    const int steps = std::max(2, static_cast<int>(length));
    for (int i = 0; i <= steps; ++i) {
        const double u = static_cast<double>(i) / steps;
        const double share = u * u * u * (10 + u * (6 * u - 15));
        const Eigen::Vector3d source = world::point_at(here, begin + u * length).position;
        const Eigen::Vector3d target =
            world::point_at(there, world::project(there, source).s).position;
        line.push_back(source + share * (target - source));
    }
    return line;
}

}  // namespace reprise::drivers

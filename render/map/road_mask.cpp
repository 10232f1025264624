#include "render/map/road_mask.h"

#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace reprise::render {

world::SensorFrame road_mask(const ground::GroundMesh& ground,
                             const world::Box& region,
                             double pixel) {
    constexpr int fraction_bits = 4;  // of a pixel, in OpenCV's fixed-point coordinates
    const Eigen::Vector2d size = (region.high - region.low) / pixel;
    world::SensorFrame mask;
    mask.kind = world::SensorKind::semantic;
    mask.width = static_cast<int>(std::ceil(size.x()));
    mask.height = static_cast<int>(std::ceil(size.y()));
    mask.channels = 1;
    mask.data.assign(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height),
                     0);
    cv::Mat sheet(mask.height, mask.width, CV_8UC1, mask.data.data());
    const auto on_sheet = [&](const Eigen::Vector3d& p) {
        const Eigen::Vector2d at = (p.head<2>() - region.low) / pixel;
        const double scale = 1 << fraction_bits;
        return cv::Point(static_cast<int>(std::lround(at.x() * scale)),
                         static_cast<int>(std::lround((mask.height - at.y()) * scale)));
    };
    for (std::size_t i = 0; i < ground.triangles.size(); ++i) {
        using ground::Surface;
        const Surface surface = ground.surfaces[i];
        if (surface != Surface::road && surface != Surface::crossing &&
            surface != Surface::sidewalk)
            continue;
        const auto& [p, q, r] = ground.triangles[i];
        const std::array<cv::Point, 3> corners{on_sheet(ground.vertices[p]),
                                               on_sheet(ground.vertices[q]),
                                               on_sheet(ground.vertices[r])};
        cv::fillConvexPoly(sheet, corners.data(), 3, cv::Scalar(255), cv::LINE_8, fraction_bits);
    }
    return mask;
}

}  // namespace reprise::render

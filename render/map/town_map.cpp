#include "render/map/town_map.h"

#include <algorithm>

#include "render/map/map_layers.h"

namespace reprise::render {

namespace {

/// All that is for cars and walkers, with room around it for what stands beside the road.
world::Box whole(const world::TownT& town) {
    world::Box box;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind != world::LaneKind::other)
            for (const world::Vec3& p : lane.centre)
                box.take(world::in_plan(p));
    const double margin = std::max(32.0, 0.02 * (box.high - box.low).maxCoeff());  // [m]
    box.low -= Eigen::Vector2d::Constant(margin);
    box.high += Eigen::Vector2d::Constant(margin);
    return box;
}

world::SensorFrame frame_of(const cv::Mat& sheet, const std::string& name) {
    world::SensorFrame frame;
    frame.name = name;
    frame.width = sheet.cols;
    frame.height = sheet.rows;
    frame.channels = 3;
    frame.data.reserve(sheet.total() * 3);
    for (int row = 0; row < sheet.rows; ++row)
        for (int column = 0; column < sheet.cols; ++column) {
            const auto& pixel = sheet.at<cv::Vec3b>(row, column);
            frame.data.insert(frame.data.end(), {pixel[2], pixel[1], pixel[0]});
        }
    return frame;
}

}  // namespace

world::SensorFrame town_map(const world::TownT& town,
                            const ground::GroundMesh& ground,
                            const ground::GroundMesh& markings,
                            const MapView& view) {
    const std::vector<LegendEntry> legend = legend_of(town);
    MapCanvas canvas(
        view.region.empty() ? whole(town) : view.region, view.size, legend_rows(legend), land_ink);
    draw_land(town, ground, canvas);
    draw_roads(town, ground, canvas);
    draw_markings(town, ground, markings, canvas);
    draw_buildings(town, canvas);
    draw_plants(town, canvas);
    draw_furniture(town, canvas);
    draw_spawn_points(town, canvas);
    draw_signals(town, canvas);
    draw_names(town, canvas);
    draw_frame(town, legend, canvas);
    return frame_of(canvas.finish(), town.name);
}

}  // namespace reprise::render

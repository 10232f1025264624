#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>

#include "ground/mesh/ground_probe.h"
#include "render/map/map_layers.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using ground::GroundMesh;
using ground::Surface;

constexpr Ink junction_ink{128, 133, 140};
constexpr Ink other_lane_ink{164, 138, 128};
constexpr Ink sidewalk_ink{216, 209, 196};
constexpr Ink kerb_ink{158, 151, 140};
constexpr double slow = 35 / 3.6;  ///< [m/s]
constexpr double fast = 62 / 3.6;

world::Loop corners_of(const GroundMesh& mesh, std::size_t triangle) {
    world::Loop corners;
    for (const std::uint32_t vertex : mesh.triangles[triangle])
        corners.push_back(mesh.vertices[vertex].head<2>());
    return corners;
}

Eigen::Vector3d middle_of(const GroundMesh& mesh, std::size_t triangle) {
    const auto& [p, q, r] = mesh.triangles[triangle];
    return (mesh.vertices[p] + mesh.vertices[q] + mesh.vertices[r]) / 3;
}

/// 1 for level land.
double brightness(const GroundMesh& mesh, std::size_t triangle) {
    const auto& [p, q, r] = mesh.triangles[triangle];
    const Eigen::Vector3d normal = (mesh.vertices[q] - mesh.vertices[p])
                                       .cross(mesh.vertices[r] - mesh.vertices[p])
                                       .normalized();
    return 1 + std::clamp(0.6 * (normal.y() - normal.x()), -0.16, 0.08);
}

/// Lanes for others than cars (buses, bicycles, trams) outside of junctions, by place.
class OtherLanes {
  public:
    explicit OtherLanes(const world::TownT& town) : town_(&town) {
        std::vector<world::BoxGrid::Entry> entries;
        for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
            if (town.lanes[i].kind == world::LaneKind::other &&
                !town.lanes[i].edge.starts_with(':'))
                entries.push_back(
                    {world::box_around(world::in_plan(town.lanes[i].centre), town.lanes[i].width),
                     i});
        by_place_ = world::BoxGrid(entries);
    }

    bool contains(const Eigen::Vector3d& p) const {
        world::Box place;
        place.take(p.head<2>());
        for (const std::uint32_t i : by_place_.near(place))
            if (world::project(town_->lanes[i], p).distance < town_->lanes[i].width / 2)
                return true;
        return false;
    }

  private:
    const world::TownT* town_;
    world::BoxGrid by_place_;
};

/// By the lane that a piece of road belongs to.
Ink ink_of_road(const world::TownT& town,
                const world::LaneMap& lanes,
                const OtherLanes& others,
                const Eigen::Vector3d& p) {
    const std::vector<world::LaneMap::Found> found = lanes.at(p, 0.1);
    for (const world::LaneMap::Found& lane : found)
        if (town.lanes[lane.lane].kind == world::LaneKind::driving)
            return road_ink(town.lanes[lane.lane].speed_limit);
    return found.empty() && others.contains(p) ? other_lane_ink : junction_ink;
}

/// Where roads are finer than lines should be: as lines.
void draw_roads_as_lines(const world::TownT& town, MapCanvas& canvas) {
    const double least = 2.4 * canvas.unit();  // [pixels]
    for (const world::LaneT& lane : town.lanes)
        if (world::is_for_cars(lane) && lane.width * canvas.pixels_per_metre() < least)
            canvas.line(
                world::in_plan(lane.centre),
                least,
                lane.kind == world::LaneKind::driving ? road_ink(lane.speed_limit) : junction_ink);
}

}  // namespace

Ink road_ink(double speed_limit) {
    if (speed_limit < slow)
        return {152, 157, 163};
    return speed_limit < fast ? Ink{124, 130, 138} : Ink{96, 103, 113};
}

Ink plot_ink(world::PlotKind kind) {
    switch (kind) {
        case world::PlotKind::lawn:
            return {213, 228, 186};
        case world::PlotKind::park:
            return {196, 220, 168};
        case world::PlotKind::square:
            return {228, 214, 190};
        case world::PlotKind::gravel:
            return {218, 208, 186};
        case world::PlotKind::water:
            return {160, 202, 226};
        case world::PlotKind::car_park:
            return {198, 199, 202};
        case world::PlotKind::playground:
            return {238, 210, 156};
        case world::PlotKind::forest:
            return {166, 200, 146};
    }
    return land_ink;
}

void draw_land(const world::TownT& town, const GroundMesh& ground, MapCanvas& canvas) {
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        if (ground.surfaces[i] == Surface::terrain)
            canvas.fill(corners_of(ground, i), land_ink.times(brightness(ground, i)));
    for (const world::PlotT& plot : town.plots)
        canvas.fill(world::in_plan(plot.outline), plot_ink(plot.kind));
}

void draw_roads(const world::TownT& town, const GroundMesh& ground, MapCanvas& canvas) {
    // Bridges last. Neighbours of one storey do not overlap, so that their order does not matter.
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        if (ground.surfaces[i] != Surface::terrain)
            order.emplace_back(middle_of(ground, i).z(), i);
    std::sort(order.begin(), order.end());
    const world::LaneMap lanes(town);
    const OtherLanes others(town);
    const bool shows_kerbs = canvas.pixels_per_metre() > 1;
    for (const auto& [z, i] : order) {
        const world::Loop corners = corners_of(ground, i);
        switch (ground.surfaces[i]) {
            case Surface::road:
                canvas.fill(corners, ink_of_road(town, lanes, others, middle_of(ground, i)));
                break;
            case Surface::crossing:
                canvas.fill(corners, junction_ink);
                break;
            case Surface::sidewalk:
                canvas.fill(corners, sidewalk_ink);
                break;
            case Surface::kerb:
                if (shows_kerbs)
                    canvas.line(corners, 0.5 * canvas.unit(), kerb_ink);
                break;
            default:
                break;
        }
    }
    draw_roads_as_lines(town, canvas);
}

}  // namespace reprise::render

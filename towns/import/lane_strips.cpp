#include "towns/import/lane_strips.h"

#include "ground/mesh/ribbon.h"
#include "ground/swept_area.h"

namespace reprise::towns {

namespace {

using world::Box;

bool overlap(const Box& one, const Box& other) {
    return (one.low.array() <= other.high.array()).all() &&
           (other.low.array() <= one.high.array()).all();
}

}  // namespace

LaneStrips::LaneStrips(const world::TownT& roads) : roads_(roads) {
    std::vector<world::BoxGrid::Entry> entries;
    for (const world::LaneT& lane : roads.lanes) {
        const Box box = world::box_around(world::in_plan(lane.centre), lane.width);
        entries.push_back({box, static_cast<std::uint32_t>(boxes_.size())});
        boxes_.push_back(box);
    }
    grid_ = world::BoxGrid(entries);
    entries.clear();
    for (const ground::SweptBody& body : ground::bus_bodies(roads)) {
        buses_.push_back(body.corners());
        entries.push_back(
            {world::box_around(buses_.back()), static_cast<std::uint32_t>(buses_.size() - 1)});
    }
    bus_grid_ = world::BoxGrid(entries);
}

Box LaneStrips::box(double margin) const {
    Box all;
    for (const Box& box : boxes_)
        all.take(box);
    all.low.array() -= margin;
    all.high.array() += margin;
    return all;
}

bool LaneStrips::is_near(const world::Loop& loop, double distance) const {
    // Most things stand beside a road, and a wide look finds thousands of lanes in a city.
    for (const double part : {0.0, 0.2, 1.0})
        if (!touching(world::box_around(loop, part * distance)).empty())
            return true;
    return false;
}

ground::Area LaneStrips::around(const world::Loop& loop, const Eigen::Vector2d& origin) const {
    constexpr double margin = 0.2;  // [m] so that no wall touches a kerb
    constexpr double at_ends = 1;   // [m] of footways end at a door: room to stand before it
    ground::Area strips(origin);
    for (const std::uint32_t index : touching(world::box_around(loop))) {
        const world::LaneT& lane = roads_.lanes[index];
        const double half = lane.width / 2 + margin;
        const ground::Ribbon ribbon =
            ground::make_ribbon(ground::clean_line(lane.centre, at_ends), -half, half);
        for (const world::Loop& part : ribbon.loops())
            strips.add(part);
    }
    for (const std::uint32_t bus : bus_grid_.near(world::box_around(loop)))
        if (overlap(world::box_around(buses_[bus]), world::box_around(loop)))
            strips.add(buses_[bus]);
    return strips;
}

std::vector<std::uint32_t> LaneStrips::touching(const Box& box) const {
    std::vector<std::uint32_t> lanes = grid_.near(box);
    std::erase_if(lanes, [&](std::uint32_t lane) { return !overlap(boxes_[lane], box); });
    return lanes;
}

}  // namespace reprise::towns

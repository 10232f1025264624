#include "exchange/page/page_town.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "exchange/page/number_column.h"
#include "world/geometry2d.h"
#include "world/tick.h"

namespace reprise::exchange {

namespace {

using nlohmann::json;

json centimetres(double metres) {
    return quantised(metres, 100);
}

/// Any points that have x() and y().
template <typename Points>
json line_of(const Points& points) {
    json line = json::array();
    std::int64_t last_x = 0, last_y = 0;
    for (const auto& point : points) {
        const std::int64_t x = quantised(point.x(), 100), y = quantised(point.y(), 100);
        line.push_back(x - last_x);
        line.push_back(y - last_y);
        last_x = x;
        last_y = y;
    }
    return line;
}

bool is_controlled(const world::LaneT& lane) {
    return std::any_of(lane.links.begin(), lane.links.end(), [](const world::Link& link) {
        return link.signal() != world::none;
    });
}

bool must_yield(const world::LaneT& lane) {
    return !lane.links.empty() &&
           std::all_of(lane.links.begin(), lane.links.end(), [](const world::Link& link) {
               return link.yields();
           });
}

/// Which paint a driving lane carries, as ground/paint does it, in short.
class Paint {
  public:
    explicit Paint(const world::TownT& town)
        : town_(town),
          has_priority_road_(town.junctions.size(), false) {
        for (const world::LaneT& lane : town.lanes) {
            if (lane.kind == world::LaneKind::sidewalk)
                with_sidewalk_.insert(lane.edge);
            if (lane.kind == world::LaneKind::driving && !lane.links.empty() && !must_yield(lane) &&
                lane.junction < has_priority_road_.size())
                has_priority_road_[lane.junction] = true;
        }
    }

    void describe(std::uint32_t index, json& out) const {
        const world::LaneT& lane = town_.lanes[index];
        const std::uint32_t inner = town_.left_hand ? lane.right : lane.left;
        const std::uint32_t outer = town_.left_hand ? lane.left : lane.right;
        if (inner != world::none)
            out["inner"] = "dashed";
        else if (lane.opposite >= town_.lanes.size())
            out["inner"] = "edge";
        else if (index < lane.opposite || town_.lanes[lane.opposite].opposite != index)
            out["inner"] = is_solid(lane) ? "solid" : "broken";
        if (outer == world::none && with_sidewalk_.count(lane.edge) == 0)
            out["outer"] = "edge";
        if (is_controlled(lane))
            out["end"] = "stop";
        else if (must_yield(lane) && lane.junction < has_priority_road_.size() &&
                 has_priority_road_[lane.junction])
            out["end"] = "yield";
    }

  private:
    /// Between opposite directions: nobody overtakes on wide or fast roads.
    static bool is_solid(const world::LaneT& lane) {
        constexpr double town_limit = 52 / 3.6;  // [m/s]
        return lane.left != world::none || lane.right != world::none ||
               lane.speed_limit > town_limit;
    }

    const world::TownT& town_;
    std::vector<bool> has_priority_road_;       ///< by junction
    std::set<std::string_view> with_sidewalk_;  ///< edges
};

json lanes_of(const world::TownT& town) {
    const Paint paint(town);
    json lanes = json::array();
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        json made = {{"name", lane.name},
                     {"kind", world::EnumNameLaneKind(lane.kind)},
                     {"width", centimetres(lane.width)},
                     {"line", line_of(lane.centre)}};
        if (!lane.outline.empty())
            made["outline"] = line_of(lane.outline);
        if (!lane.street.empty())
            made["street"] = lane.street;
        if (lane.kind == world::LaneKind::driving) {
            made["limit"] = lane.speed_limit;
            paint.describe(i, made);
        }
        lanes.push_back(made);
    }
    return lanes;
}

json buildings_of(const world::TownT& town) {
    json buildings = json::array();
    for (const world::Building& building : town.buildings) {
        const Eigen::Vector2d ahead = world::ahead_of(building.yaw()) * building.length() / 2;
        const Eigen::Vector2d left = world::left_of(building.yaw()) * building.width() / 2;
        const Eigen::Vector2d centre = world::in_plan(building.centre());
        const world::Loop corners{centre - ahead - left,
                                  centre + ahead - left,
                                  centre + ahead + left,
                                  centre - ahead + left};
        buildings.push_back({{"outline", line_of(corners)},
                             {"height", building.height()},
                             {"style", building.style() % 1000}});
    }
    for (const world::DrawnBuildingT& building : town.drawn_buildings)
        buildings.push_back({{"outline", line_of(building.outline)},
                             {"height", building.height},
                             {"style", building.style % 1000}});
    return buildings;
}

json props_of(const world::TownT& town) {
    json props = json::array();
    for (const world::Prop& prop : town.props)
        props.push_back({world::EnumNamePropKind(prop.kind()),
                         centimetres(prop.position().x()),
                         centimetres(prop.position().y()),
                         quantised(prop.yaw(), 1000),
                         centimetres(prop.length()),
                         centimetres(prop.width()),
                         prop.value()});
    return props;
}

json signals_of(const world::TownT& town) {
    json signals = json::array();
    for (const world::SignalT& signal : town.signals) {
        const bool faces_lane = signal.lane < town.lanes.size();
        signals.push_back({centimetres(signal.position.x()),
                           centimetres(signal.position.y()),
                           quantised(signal.yaw, 1000),
                           faces_lane && !signal.for_walkers ? static_cast<int>(signal.lane) : -1});
    }
    return signals;
}

}  // namespace

json page_town(const world::TownT& town) {
    json made = {{"name", town.name},
                 {"left_hand", town.left_hand},
                 {"low", {town.low.x(), town.low.y()}},
                 {"high", {town.high.x(), town.high.y()}},
                 {"lanes", lanes_of(town)},
                 {"buildings", buildings_of(town)},
                 {"props", props_of(town)},
                 {"signals", signals_of(town)}};
    made["junctions"] = json::array();
    for (const world::JunctionT& junction : town.junctions)
        if (junction.outline.size() > 2)
            made["junctions"].push_back(line_of(junction.outline));
    made["plots"] = json::array();
    for (const world::PlotT& plot : town.plots)
        made["plots"].push_back(
            {{"kind", world::EnumNamePlotKind(plot.kind)}, {"outline", line_of(plot.outline)}});
    made["trees"] = json::array();
    for (const world::Tree& tree : town.trees)
        made["trees"].push_back({centimetres(tree.position().x()),
                                 centimetres(tree.position().y()),
                                 centimetres(tree.crown_radius()),
                                 tree.kind()});
    return made;
}

}  // namespace reprise::exchange

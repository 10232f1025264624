#include "traffic/roads/car_network.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include <libsumo/libsumo.h>
#include <pugixml.hpp>

#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"
#include "world/town.h"
#include "world/words.h"

namespace reprise::traffic {

namespace {

using Names = std::set<std::string, std::less<>>;

/// What SUMO calls the classes of all that we let it drive.
world::ClassSet fleet() {
    world::ClassSet classes = 0;
    for (const world::VehicleModel& model : world::vehicle_models())
        classes |= world::class_bit(model.sumo_class);
    return classes;
}

void close(pugi::xml_node lane) {
    pugi::xml_attribute allow = lane.attribute("allow");
    if ((world::permitted(allow.value(), lane.attribute("disallow").value()) & fleet()) == 0)
        return;
    lane.remove_attribute("disallow");
    if (!allow)
        allow = lane.append_attribute("allow");
    allow.set_value("pedestrian");
}

bool is_path(const pugi::xml_node& edge) {
    const std::string_view function = edge.attribute("function").value();
    return function == "crossing" || function == "walkingarea";
}

/// Of one network: what goes, in the order in which one thing takes the next one with it.
class Reduction {
  public:
    Reduction(pugi::xml_node net, const world::TownT& town) : net_(net) {
        for (const world::LaneT& lane : town.lanes)
            if (lane.kind == world::LaneKind::driving) {
                driven_lanes_.insert(lane.name);
                driven_roads_.insert(lane.edge);
            }
        for (const pugi::xml_node& edge : net_.children("edge"))
            look_at(edge);
        find_connections();
    }

    /// False, and nothing done, of a network whose junctions count their ways otherwise than SUMO.
    bool reduce() {
        std::vector<std::pair<pugi::xml_node, std::vector<bool>>> junctions;
        for (const pugi::xml_node& junction : net_.children("junction")) {
            std::vector<bool> stays = ways_that_stay(junction);
            const auto requests = junction.children("request");
            const auto count = std::distance(requests.begin(), requests.end());
            if (count != 0 && count != static_cast<std::ptrdiff_t>(stays.size()))
                return false;
            if (count == 0)
                stays.clear();
            junctions.emplace_back(junction, std::move(stays));
        }
        for (const auto& [junction, stays] : junctions) {
            // Where one waits within a junction is one itself, of the name of the lane behind it.
            if (gone_.contains(junction.attribute("id").value()))
                net_.remove_child(junction);
            else
                reduce_junction(junction, stays);
        }
        reduce_edges();
        reduce_connections();
        return true;
    }

  private:
    /// Of an edge: its lanes, by the index that the network gives them.
    using Lanes = std::map<int, std::string>;

    void look_at(const pugi::xml_node& edge) {
        Lanes& lanes = lanes_[edge.attribute("id").value()];
        const bool is_driven = driven_roads_.contains(edge.attribute("id").value());
        for (const pugi::xml_node& lane : edge.children("lane")) {
            const std::string name = lane.attribute("id").value();
            lanes[lane.attribute("index").as_int()] = name;
            if (is_path(edge) || (is_driven && !driven_lanes_.contains(name)))
                gone_.insert(name);
        }
    }

    const std::string& lane_of(const pugi::xml_node& connection,
                               const char* edge,
                               const char* lane) const {
        static const std::string unknown;
        const auto lanes = lanes_.find(std::string_view(connection.attribute(edge).value()));
        if (lanes == lanes_.end())
            return unknown;
        const auto found = lanes->second.find(connection.attribute(lane).as_int());
        return found == lanes->second.end() ? unknown : found->second;
    }

    bool goes(const pugi::xml_node& connection) const {
        return gone_.contains(lane_of(connection, "from", "fromLane")) ||
               gone_.contains(lane_of(connection, "to", "toLane"));
    }

    /// With a way between two roads its lanes in the junction go.
    void find_connections() {
        for (bool is_more = true; is_more;) {
            is_more = false;
            for (const pugi::xml_node& connection : net_.children("connection")) {
                const pugi::xml_attribute via = connection.attribute("via");
                if (via && goes(connection) && gone_.insert(via.value()).second)
                    is_more = true;
            }
        }
        for (const pugi::xml_node& connection : net_.children("connection"))
            from_[lane_of(connection, "from", "fromLane")].push_back(connection);
    }

    /// In the order in which a junction's requests count them: SUMO's MSRightOfWayJunction.
    std::vector<bool> ways_that_stay(const pugi::xml_node& junction) const {
        std::vector<bool> stays;
        for (const std::string_view lane : world::words(junction.attribute("incLanes").value())) {
            const auto found = from_.find(lane);
            if (found == from_.end())
                continue;
            for (const pugi::xml_node& way : found->second)
                if (is_counted(way))
                    stays.push_back(!goes(way));
        }
        return stays;
    }

    static bool starts_at(const pugi::xml_node& connection, const char* edge, const char* kind) {
        // SUMO's names of paths: :JUNCTION_w0, :JUNCTION_c0.
        const std::string_view name = connection.attribute(edge).value();
        const auto at = name.rfind('_');
        return name.starts_with(':') && at != name.npos && name.substr(at + 1).starts_with(kind);
    }

    static bool is_counted(const pugi::xml_node& way) {
        return !starts_at(way, "to", "w") &&
               (!starts_at(way, "from", "w") || starts_at(way, "to", "c"));
    }

    void keep_names(pugi::xml_attribute list) const {
        std::string left;
        for (const std::string_view lane : world::words(list.value()))
            if (!gone_.contains(lane))
                left.append(left.empty() ? "" : " ").append(lane);
        list.set_value(left.c_str());
    }

    void reduce_junction(pugi::xml_node junction, const std::vector<bool>& stays) const {
        keep_names(junction.attribute("incLanes"));
        keep_names(junction.attribute("intLanes"));
        // Bits: those of the first way last.
        const auto keep_bits = [&](pugi::xml_attribute bits) {
            const std::string_view before = bits.value();
            std::string left;
            for (std::size_t i = 0; i < before.size(); ++i)
                if (stays[before.size() - 1 - i])
                    left += before[i];
            bits.set_value(left.c_str());
        };
        int next_index = 0;
        std::size_t at = 0;
        for (pugi::xml_node request = junction.child("request"); request; ++at) {
            const pugi::xml_node next = request.next_sibling("request");
            if (stays[at]) {
                request.attribute("index").set_value(next_index++);
                keep_bits(request.attribute("response"));
                keep_bits(request.attribute("foes"));
            } else {
                junction.remove_child(request);
            }
            request = next;
        }
    }

    void reduce_edges() {
        for (pugi::xml_node edge = net_.child("edge"); edge;) {
            const pugi::xml_node next = edge.next_sibling("edge");
            reduce_edge(edge);
            if (!edge.child("lane"))
                net_.remove_child(edge);
            edge = next;
        }
    }

    void reduce_edge(pugi::xml_node edge) {
        const bool is_road = !edge.attribute("function");
        const bool is_driven = driven_roads_.contains(edge.attribute("id").value());
        std::map<int, int>& indices = indices_[edge.attribute("id").value()];
        int next_index = 0;
        for (pugi::xml_node lane = edge.child("lane"); lane;) {
            const pugi::xml_node next = lane.next_sibling("lane");
            while (lane.remove_child("neigh")) {
            }
            if (gone_.contains(lane.attribute("id").value())) {
                edge.remove_child(lane);
            } else {
                if (is_road && !is_driven)
                    close(lane);
                indices[lane.attribute("index").as_int()] = next_index;
                lane.attribute("index").set_value(next_index++);
            }
            lane = next;
        }
    }

    void reduce_connections() {
        const auto count_anew = [&](pugi::xml_node connection, const char* edge, const char* lane) {
            const auto indices =
                indices_.find(std::string_view(connection.attribute(edge).value()));
            if (indices == indices_.end())
                return;
            const auto index = indices->second.find(connection.attribute(lane).as_int());
            if (index != indices->second.end())
                connection.attribute(lane).set_value(index->second);
        };
        for (pugi::xml_node connection = net_.child("connection"); connection;) {
            const pugi::xml_node next = connection.next_sibling("connection");
            if (goes(connection)) {
                net_.remove_child(connection);
            } else {
                count_anew(connection, "from", "fromLane");
                count_anew(connection, "to", "toLane");
            }
            connection = next;
        }
    }

    pugi::xml_node net_;
    Names driven_lanes_;
    Names driven_roads_;
    Names gone_;                                                            ///< lanes
    std::map<std::string, Lanes, std::less<>> lanes_;                       ///< by edge
    std::map<std::string, std::map<int, int>, std::less<>> indices_;        ///< by edge: new by old
    std::map<std::string, std::vector<pugi::xml_node>, std::less<>> from_;  ///< by lane
};

/// To the end of a text.
struct TextWriter : pugi::xml_writer {
    void write(const void* data, std::size_t size) override {
        text.append(static_cast<const char*>(data), size);
    }

    std::string text;
};

}  // namespace

std::string network_for_cars(std::string_view network, const world::TownT& town) {
    pugi::xml_document document;
    if (!document.load_buffer(network.data(), network.size()) ||
        !Reduction(document.child("net"), town).reduce())
        return std::string(network);
    TextWriter writer;
    document.save(writer, "", pugi::format_raw);
    return std::move(writer.text);
}

std::vector<bool> lanes_in_sumo(const world::TownT& town) {
    const std::vector<std::string> names = libsumo::Lane::getIDList();
    const std::unordered_set<std::string_view> known(names.begin(), names.end());
    std::vector<bool> has(town.lanes.size());
    std::transform(town.lanes.begin(), town.lanes.end(), has.begin(), [&](const auto& lane) {
        return known.contains(lane.name);
    });
    return has;
}

}  // namespace reprise::traffic

#include "traffic/give_way.h"

#include <algorithm>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "traffic/network_xml.h"
#include "world/town.h"

namespace reprise::traffic {

namespace {

/// For each link of a junction, in the order of its index: does it give way to a vehicle?
using Answers = std::vector<bool>;

/// Crossings are the last links of a junction; "response" has the first link rightmost.
Answers answers_of(const pugi::xml_node& junction) {
    const std::string_view lanes = junction.attribute("intLanes").value();
    std::size_t crossings = 0;
    const std::string mark = std::string(":") + junction.attribute("id").value() + "_c";
    for (std::size_t at = lanes.find(mark); at != std::string_view::npos;
         at = lanes.find(mark, at + 1))
        ++crossings;
    std::map<std::size_t, std::string_view> responses;
    for (const pugi::xml_node request : junction.children("request"))
        responses[request.attribute("index").as_uint()] = request.attribute("response").value();
    const std::size_t vehicles = responses.size() - std::min(crossings, responses.size());
    Answers answers;
    for (const auto& [index, response] : responses) {
        if (index != answers.size())
            break;
        bool gives_way = false;
        for (std::size_t i = 0; i < std::min(vehicles, response.size()); ++i)
            gives_way = gives_way || response[response.size() - 1 - i] == '1';
        answers.push_back(gives_way);
    }
    return answers;
}

/// The index of a link in its junction: its internal lane is called :JUNCTION_FIRST_OFFSET.
std::size_t link_index(std::string_view via) {
    constexpr std::size_t unknown = 1U << 20;
    const std::size_t offset = via.rfind('_');
    if (offset == std::string_view::npos || offset == 0)
        return unknown;
    const std::size_t first = via.rfind('_', offset - 1);
    if (first == std::string_view::npos)
        return unknown;
    return static_cast<std::size_t>(
        number(via.substr(first + 1, offset - first - 1), static_cast<double>(unknown)) +
        number(via.substr(offset + 1), 0));
}

/// What is known of the links of one lane.
struct Seen {
    bool any = false;
    bool all_yield = true;
    bool all_stop = true;
};

}  // namespace

std::vector<GiveWay> read_give_way(const pugi::xml_node& net, const world::TownT& town) {
    std::map<std::string, Answers> answers;
    for (const pugi::xml_node junction : net.children("junction")) {
        const std::string_view type = junction.attribute("type").value();
        if (type == "priority" || type.find("stop") != std::string_view::npos)
            answers[junction.attribute("id").value()] = answers_of(junction);
    }
    std::vector<Seen> seen(town.lanes.size());
    for (const pugi::xml_node connection : net.children("connection")) {
        const std::string from = std::string(connection.attribute("from").value()) + "_" +
                                 connection.attribute("fromLane").value();
        const auto lane = world::find_lane(town, from);
        if (!lane || town.lanes[*lane].kind != world::LaneKind::driving ||
            town.lanes[*lane].junction == world::none ||
            *connection.attribute("dir").value() == 't' ||
            *connection.attribute("to").value() == ':')  // walkers, onto the pavement
            continue;
        const auto junction = answers.find(town.junctions[town.lanes[*lane].junction].name);
        if (junction == answers.end())
            continue;
        const std::size_t index = link_index(connection.attribute("via").value());
        const char state = *connection.attribute("state").value();
        Seen& here = seen[*lane];
        here.any = true;
        here.all_stop = here.all_stop && (state == 's' || state == 'w');
        here.all_yield =
            here.all_yield && index < junction->second.size() && junction->second[index];
    }
    std::vector<GiveWay> found;
    for (const Seen& each : seen)
        found.push_back(!each.any        ? GiveWay::none
                        : each.all_stop  ? GiveWay::stop
                        : each.all_yield ? GiveWay::yield
                                         : GiveWay::none);
    return found;
}

}  // namespace reprise::traffic

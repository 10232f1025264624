#include "towns/furnish/give_way.h"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/town.h"

namespace reprise::towns {

namespace {

/// One link of a junction, walkers on crossings left out.
struct Answer {
    bool meets = false;  ///< is there any vehicle that it could meet?
    bool gives_way = false;
};

/// In the order of the links' indices.
using Answers = std::vector<Answer>;

/// Has a row of bits, the first link rightmost, one of the first `count`?
bool any_of_first(std::string_view row, std::size_t count) {
    return row.substr(row.size() - std::min(count, row.size())).find('1') != std::string_view::npos;
}

/// Crossings are the last links of a junction.
Answers answers_of(const pugi::xml_node& junction) {
    const std::string_view lanes = junction.attribute("intLanes").value();
    std::size_t crossings = 0;
    const std::string mark = std::string(":") + junction.attribute("id").value() + "_c";
    for (std::size_t at = lanes.find(mark); at != std::string_view::npos;
         at = lanes.find(mark, at + 1))
        ++crossings;
    std::map<std::size_t, pugi::xml_node> requests;
    for (const pugi::xml_node request : junction.children("request"))
        requests[request.attribute("index").as_uint()] = request;
    const std::size_t vehicles = requests.size() - std::min(crossings, requests.size());
    Answers answers;
    for (const auto& [index, request] : requests) {
        if (index != answers.size())
            break;
        answers.push_back({any_of_first(request.attribute("foes").value(), vehicles),
                           any_of_first(request.attribute("response").value(), vehicles)});
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

/// What is known of the links of one road, turnarounds left out.
struct Seen {
    bool gives_way = false;
    bool goes_first = false;  ///< before somebody that it meets
    bool always_halts = true;
    bool allway_stop = false;
};

GiveWay sign_for(const Seen& seen) {
    const bool minor = seen.gives_way && !seen.goes_first;
    // A main road's links may be stops just for the crossings behind them.
    if (seen.always_halts && (minor || seen.allway_stop))
        return GiveWay::stop;
    return minor ? GiveWay::yield : GiveWay::none;
}

}  // namespace

std::vector<GiveWay> read_give_way(const pugi::xml_node& net, const world::TownT& town) {
    std::map<std::string, Answers> answers;
    for (const pugi::xml_node junction : net.children("junction")) {
        const std::string_view type = junction.attribute("type").value();
        if (type == "priority" || type.find("stop") != std::string_view::npos)
            answers[junction.attribute("id").value()] = answers_of(junction);
    }
    std::map<std::string, Seen> roads;
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
        // Networks without internal lanes: their stops are taken at their word.
        const Answer answer =
            index < junction->second.size() ? junction->second[index] : Answer{true, state == 's'};
        Seen& here = roads[town.lanes[*lane].edge];
        here.gives_way = here.gives_way || answer.gives_way;
        here.goes_first = here.goes_first || (answer.meets && !answer.gives_way);
        here.always_halts = here.always_halts && (state == 's' || state == 'w');
        here.allway_stop = here.allway_stop || state == 'w';
    }
    std::vector<GiveWay> found(town.lanes.size(), GiveWay::none);
    for (std::size_t i = 0; i < town.lanes.size(); ++i)
        if (const auto seen = roads.find(town.lanes[i].edge);
            seen != roads.end() && town.lanes[i].kind == world::LaneKind::driving)
            found[i] = sign_for(seen->second);
    return found;
}

}  // namespace reprise::towns

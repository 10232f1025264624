#include "towns/network/junction_links.h"

#include <algorithm>

#include "world/words.h"

namespace reprise::towns {

JunctionLinks::JunctionLinks(pugi::xml_node net) {
    for (const pugi::xml_node edge : net.children("edge"))
        functions_[edge.attribute("id").value()] = edge.attribute("function").value();
    for (const pugi::xml_node link : net.children("connection"))
        links_[std::string(link.attribute("from").value()) + "_" +
               link.attribute("fromLane").value()]
            .push_back(link);
}

std::vector<JunctionLink> JunctionLinks::through(pugi::xml_node junction) const {
    std::vector<JunctionLink> ways = through_and_over(junction);
    std::erase_if(ways, [](const JunctionLink& way) { return way.walks; });
    return ways;
}

std::vector<JunctionLink> JunctionLinks::through_and_over(pugi::xml_node junction) const {
    std::vector<JunctionLink> ways;
    std::size_t index = 0;
    for (const std::string_view lane : world::words(junction.attribute("incLanes").value()))
        for (const pugi::xml_node link : from(lane)) {
            const std::string_view to = function(link, "to");
            const bool walks = function(link, "from") == "walkingarea";
            if (to == "walkingarea" || (walks && to != "crossing"))
                continue;
            if (walks || *link.attribute("via").value() != '\0')
                ways.push_back({index,
                                link,
                                link.attribute("from").value(),
                                link.attribute("to").value(),
                                link.attribute("toLane").value(),
                                walks});
            ++index;
        }
    return ways;
}

const std::vector<pugi::xml_node>& JunctionLinks::from(std::string_view lane) const {
    static const std::vector<pugi::xml_node> none;
    const auto found = links_.find(lane);
    return found == links_.end() ? none : found->second;
}

std::string_view JunctionLinks::function(pugi::xml_node link, const char* end) const {
    const auto found = functions_.find(link.attribute(end).value());
    return found == functions_.end() ? "" : found->second;
}

JunctionRows::JunctionRows(pugi::xml_node junction) {
    for (const pugi::xml_node request : junction.children("request"))
        requests_.push_back(request);
}

bool JunctionRows::are_foes(std::size_t one, std::size_t other) const {
    return has(one, "foes", other) || has(other, "foes", one);
}

bool JunctionRows::gives_way(std::size_t one, std::size_t other) const {
    return has(one, "response", other);
}

std::size_t JunctionRows::given_way(std::size_t index) const {
    if (index >= requests_.size())
        return 0;
    const std::string_view row = requests_[index].attribute("response").value();
    return static_cast<std::size_t>(std::count(row.begin(), row.end(), '1'));
}

void JunctionRows::goes_before(std::size_t one, std::size_t other) {
    clear(one, "response", other);
}

void JunctionRows::part(std::size_t one, std::size_t other) {
    for (const char* row : {"response", "foes"}) {
        clear(one, row, other);
        clear(other, row, one);
    }
}

bool JunctionRows::has(std::size_t index, const char* name, std::size_t bit) const {
    if (index >= requests_.size())
        return false;
    const std::string_view row = requests_[index].attribute(name).value();
    return bit < row.size() && row[row.size() - 1 - bit] == '1';
}

void JunctionRows::clear(std::size_t index, const char* name, std::size_t bit) {
    if (!has(index, name, bit))
        return;
    std::string row = requests_[index].attribute(name).value();
    row[row.size() - 1 - bit] = '0';
    requests_[index].attribute(name).set_value(row.c_str());
}

}  // namespace reprise::towns

#include "towns/network/zippers.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "towns/network/junction_links.h"

namespace reprise::towns {

namespace {

bool is_zipped(const JunctionLink& link) {
    return std::string_view(link.xml.attribute("state").value()) == "Z";
}

bool goes_straight_on(const JunctionLink& link) {
    return std::string_view(link.xml.attribute("dir").value()) == "s";
}

/// Of two links that give way to each other.
bool goes_first(const JunctionLink& one, const JunctionLink& other) {
    return goes_straight_on(one) != goes_straight_on(other) ? goes_straight_on(one)
                                                            : one.index < other.index;
}

}  // namespace

std::size_t mend_zippers(pugi::xml_node net) {
    const JunctionLinks links(net);
    std::size_t mended = 0;
    for (pugi::xml_node junction : net.children("junction")) {
        if (std::string_view(junction.attribute("type").value()) != "zipper")
            continue;
        JunctionRows rows(junction);
        std::vector<JunctionLink> ways = links.through(junction);
        if (std::none_of(ways.begin(), ways.end(), [&](const JunctionLink& way) {
                return is_zipped(way) && rows.given_way(way.index) > 1;
            }))
            continue;
        for (const JunctionLink& one : ways)
            for (const JunctionLink& other : ways)
                if (rows.gives_way(one.index, other.index) &&
                    rows.gives_way(other.index, one.index) && goes_first(one, other))
                    rows.goes_before(one.index, other.index);
        for (JunctionLink& way : ways)
            if (is_zipped(way))
                way.xml.attribute("state").set_value(rows.given_way(way.index) == 0 ? "M" : "m");
        junction.attribute("type").set_value("priority");
        ++mended;
    }
    return mended;
}

}  // namespace reprise::towns

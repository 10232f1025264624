// What it must do: close the outlines of multipolygons that are drawn as several ways.
// What it assumes: XML that netconvert has read; maps of gigabytes, of which little is relations.
// How it goes: libosmium reads the relations, then the ways that they name; those are joined, outer
//   and inner ones apart. libosmium's own assembler of areas would need the positions of all nodes,
//   and gives up a multipolygon of which one ring is open, as extracts have them at their edges.
// What it keeps: the order of the relations' ids.
#include "towns/maps/map_rings.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <osmium/osm/relation.hpp>
#include <osmium/osm/way.hpp>
#include <pugixml.hpp>

#include "towns/maps/joined_ways.h"
#include "towns/maps/map_area.h"
#include "towns/maps/osm_objects.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::towns {

namespace {

using Id = osmium::object_id_type;
using Ways = std::map<Id, NodeIds>;

constexpr Id first_ring = 1'000'000'000'000'000;  ///< larger than any id of OpenStreetMap

struct Multipolygon {
    Id id = 0;
    Tags tags;
    std::vector<Id> outer, inner;  ///< ways
};

/// Those that a town shows, each once, by their ids.
std::vector<Multipolygon> read_multipolygons(const std::filesystem::path& map) {
    std::vector<Multipolygon> found;
    const auto take = [&](const osmium::Relation& relation) {
        if (!relation.tags().has_tag("type", "multipolygon"))
            return;
        Multipolygon area{relation.id(), {}, {}, {}};
        for (const osmium::Tag& tag : relation.tags())
            area.tags.insert_or_assign(tag.key(), tag.value());
        if (!is_building(area.tags) && !plot_kind(area.tags))
            return;
        for (const osmium::RelationMember& member : relation.members())
            if (member.type() == osmium::item_type::way)
                (std::string_view(member.role()) == "inner" ? area.inner : area.outer)
                    .push_back(member.ref());
        found.push_back(std::move(area));
    };
    for_each_object<osmium::Relation>(map, osmium::osm_entity_bits::relation, take);
    std::stable_sort(found.begin(), found.end(), [](const auto& left, const auto& right) {
        return left.id < right.id;
    });
    const auto repeated =
        std::unique(found.begin(), found.end(), [](const auto& left, const auto& right) {
            return left.id == right.id;
        });
    found.erase(repeated, found.end());
    return found;
}

/// The nodes of all members; none for ways that an extract lacks.
Ways read_members(const std::filesystem::path& map, const std::vector<Multipolygon>& areas) {
    Ways ways;
    for (const Multipolygon& area : areas)
        for (const std::vector<Id>* members : {&area.outer, &area.inner})
            for (const Id member : *members)
                ways.try_emplace(member);
    if (ways.empty())
        return ways;
    for_each_object<osmium::Way>(map, osmium::osm_entity_bits::way, [&](const osmium::Way& way) {
        const auto wanted = ways.find(way.id());
        if (wanted == ways.end() || !wanted->second.empty())
            return;
        for (const osmium::NodeRef& node : way.nodes())
            wanted->second.push_back(node.ref());
    });
    return ways;
}

/// Members that are rings by themselves are left out: polyconvert knows those.
JoinedWays join(const std::vector<Id>& members, const Ways& ways) {
    std::set<Id> seen;
    std::vector<const NodeIds*> open;
    bool lacks_ways = false;
    for (const Id member : members) {
        const NodeIds& way = ways.at(member);
        if (way.size() < 2)
            lacks_ways = true;
        else if (seen.insert(member).second && way.front() != way.back())
            open.push_back(&way);
    }
    JoinedWays joined = join_ways(open);
    joined.all_close = joined.all_close && !lacks_ways;
    return joined;
}

void write_ring(pugi::xml_node osm, Id id, const NodeIds& ring, const Tags& tags) {
    pugi::xml_node way = osm.append_child("way");
    way.append_attribute("id").set_value(static_cast<long long>(id));
    for (const Id node : ring)
        way.append_child("nd").append_attribute("ref").set_value(static_cast<long long>(node));
    for (const auto& [key, value] : tags) {
        pugi::xml_node tag = way.append_child("tag");
        tag.append_attribute("k").set_value(key.c_str());
        tag.append_attribute("v").set_value(value.c_str());
    }
}

MapRings write_rings(const std::vector<Multipolygon>& areas, const Ways& ways) {
    MapRings found;
    pugi::xml_document document;
    pugi::xml_node osm = document.append_child("osm");
    osm.append_attribute("version").set_value("0.6");
    Id next = first_ring;
    for (const Multipolygon& area : areas) {
        const JoinedWays outer = join(area.outer, ways), inner = join(area.inner, ways);
        found.open += outer.all_close && inner.all_close ? 0 : 1;
        for (const JoinedWays* joined : {&outer, &inner})
            for (const NodeIds& ring : joined->rings)
                write_ring(osm, next++, ring, area.tags);
    }
    if (next == first_ring)
        return found;
    std::ostringstream text;
    document.save(text, "", pugi::format_raw);
    found.osm = std::move(text).str();
    return found;
}

}  // namespace

MapRings read_rings(const std::filesystem::path& map, const std::string& called) {
    try {
        const std::vector<Multipolygon> areas = read_multipolygons(map);
        return write_rings(areas, read_members(map, areas));
    } catch (const std::exception& error) {
        throw world::Error(fmt::format(
            "{}: is not as OpenStreetMap writes it: {}", called, world::printable(error.what())));
    }
}

}  // namespace reprise::towns

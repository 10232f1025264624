// What it must do: close the outlines of multipolygons that are drawn as several ways.
// What it assumes: XML that netconvert has read; maps of gigabytes, of which little is relations.
// How it goes: the relations first, then the ways that they name, each parsed by itself out of the
//   mapped file; then ways are joined end to end, outer and inner ones apart.
// What it keeps: the order of the file.
#include "towns/maps/map_rings.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <pugixml.hpp>

#include "towns/maps/map_area.h"

namespace reprise::towns {

namespace {

using Id = long long;
using Line = std::vector<Id>;  ///< nodes

constexpr Id first_ring = 1'000'000'000'000'000;  ///< larger than any id of OpenStreetMap
constexpr std::size_t nowhere = std::string_view::npos;

/// Behind the '>' of the tag that begins at `from`; attributes may hold others.
std::size_t end_of_tag(std::string_view xml, std::size_t from) {
    char quote = 0;
    for (std::size_t at = from; at < xml.size(); ++at) {
        const char c = xml[at];
        if (quote == 0 && c == '>')
            return at + 1;
        if (quote == 0 && (c == '"' || c == '\''))
            quote = c;
        else if (c == quote)
            quote = 0;
    }
    return nowhere;
}

/// Behind the element whose first tag is [from, end).
std::size_t end_of_element(std::string_view xml, std::string_view name, std::size_t end) {
    if (xml[end - 2] == '/')
        return end;
    const std::size_t closing = xml.find("</" + std::string(name), end);
    return closing == nowhere ? nowhere : end_of_tag(xml, closing);
}

/// The map's "<?xml ...?>", which tells its encoding; "" when it has none.
std::string_view declaration(std::string_view xml) {
    const std::size_t start = xml.substr(0, 4).find('<');  // behind a byte order mark
    return start != nowhere && xml.substr(start).starts_with("<?xml")
               ? xml.substr(start, end_of_tag(xml, start) - start)
               : "";
}

/// Calls `take` with the text of each element of that name.
template <typename Take>
void for_each_element(std::string_view xml, std::string_view name, Take&& take) {
    for (std::size_t at = xml.find('<'); at != nowhere; at = xml.find('<', at)) {
        const std::string_view rest = xml.substr(at + 1);
        const bool is_comment = rest.starts_with("!--");
        std::size_t end = is_comment ? xml.find("-->", at) : end_of_tag(xml, at);
        if (!is_comment && end != nowhere && rest.starts_with(name) &&
            rest.find_first_of(" \t\r\n/>") == name.size()) {
            end = end_of_element(xml, name, end);
            if (end != nowhere)
                take(xml.substr(at, end - at));
        }
        if (end == nowhere)
            return;
        at = end;
    }
}

/// Ways of one role.
using Members = std::vector<Id>;

struct Relation {
    Tags tags;
    Members outer, inner;
};

bool is_shown(const Tags& tags) {
    const auto type = tags.find("type");
    return type != tags.end() && type->second == "multipolygon" &&
           (is_building(tags) || plot_kind(tags));
}

std::vector<Relation> read_relations(std::string_view xml) {
    std::vector<Relation> relations;
    for_each_element(xml, "relation", [&](std::string_view element) {
        pugi::xml_document document;
        document.load_buffer(element.data(), element.size());
        const pugi::xml_node node = document.document_element();
        Relation relation;
        for (const pugi::xml_node tag : node.children("tag"))
            relation.tags[tag.attribute("k").value()] = tag.attribute("v").value();
        if (!is_shown(relation.tags))
            return;
        for (const pugi::xml_node member : node.children("member")) {
            if (std::string_view(member.attribute("type").value()) != "way")
                continue;
            const bool inner = std::string_view(member.attribute("role").value()) == "inner";
            (inner ? relation.inner : relation.outer).push_back(member.attribute("ref").as_llong());
        }
        relations.push_back(std::move(relation));
    });
    return relations;
}

std::map<Id, Line> read_ways(std::string_view xml, const std::set<Id>& wanted) {
    std::map<Id, Line> ways;
    for_each_element(xml, "way", [&](std::string_view element) {
        pugi::xml_document document;
        document.load_buffer(element.data(), end_of_tag(element, 0), pugi::parse_fragment);
        if (!wanted.contains(document.first_child().attribute("id").as_llong()))
            return;
        document.load_buffer(element.data(), element.size());
        const pugi::xml_node way = document.document_element();
        Line& line = ways[way.attribute("id").as_llong()];
        for (const pugi::xml_node node : way.children("nd"))
            line.push_back(node.attribute("ref").as_llong());
    });
    return ways;
}

/// Joins ways end to end, in either direction.
class Joiner {
  public:
    Joiner(const Members& members, const std::map<Id, Line>& ways);

    std::vector<Line> rings;  ///< that close, of two ways or more
    bool all_close = true;

  private:
    const Line* take_at(Id node);
    void follow(Line ring);

    std::multimap<Id, const Line*> by_end_;
    std::set<const Line*> used_;
};

Joiner::Joiner(const Members& members, const std::map<Id, Line>& ways) {
    std::vector<const Line*> open;
    for (const Id member : members) {
        const auto way = ways.find(member);
        if (way == ways.end() || way->second.size() < 2) {
            all_close = false;
            continue;
        }
        const Line& line = way->second;
        if (line.front() == line.back())
            continue;
        open.push_back(&line);
        by_end_.emplace(line.front(), &line);
        by_end_.emplace(line.back(), &line);
    }
    for (const Line* line : open)
        if (used_.insert(line).second)
            follow(*line);
}

const Line* Joiner::take_at(Id node) {
    const auto [first, last] = by_end_.equal_range(node);
    const auto found = std::find_if(
        first, last, [&](const auto& entry) { return used_.insert(entry.second).second; });
    return found == last ? nullptr : found->second;
}

void Joiner::follow(Line ring) {
    while (ring.front() != ring.back()) {
        const Line* next = take_at(ring.back());
        if (next == nullptr) {
            all_close = false;
            return;
        }
        if (next->front() == ring.back())
            ring.insert(ring.end(), next->begin() + 1, next->end());
        else
            ring.insert(ring.end(), next->rbegin() + 1, next->rend());
    }
    rings.push_back(std::move(ring));
}

void write_ring(pugi::xml_node osm, Id id, const Line& ring, const Tags& tags) {
    pugi::xml_node way = osm.append_child("way");
    way.append_attribute("id").set_value(id);
    for (const Id node : ring)
        way.append_child("nd").append_attribute("ref").set_value(node);
    for (const auto& [key, value] : tags) {
        pugi::xml_node tag = way.append_child("tag");
        tag.append_attribute("k").set_value(key.c_str());
        tag.append_attribute("v").set_value(value.c_str());
    }
}

}  // namespace

MapRings read_rings(const std::filesystem::path& map) {
    const boost::interprocess::file_mapping file(map.c_str(), boost::interprocess::read_only);
    const boost::interprocess::mapped_region region(file, boost::interprocess::read_only);
    const std::string_view xml(static_cast<const char*>(region.get_address()), region.get_size());

    const std::vector<Relation> relations = read_relations(xml);
    std::set<Id> wanted;
    for (const Relation& relation : relations)
        for (const Members* members : {&relation.outer, &relation.inner})
            wanted.insert(members->begin(), members->end());
    if (wanted.empty())
        return {};
    const std::map<Id, Line> ways = read_ways(xml, wanted);

    MapRings found;
    pugi::xml_document document;
    pugi::xml_node osm = document.append_child("osm");
    osm.append_attribute("version").set_value("0.6");
    Id next = first_ring;
    for (const Relation& relation : relations) {
        const Joiner outer(relation.outer, ways), inner(relation.inner, ways);
        found.open += outer.all_close && inner.all_close ? 0 : 1;
        for (const Joiner* joiner : {&outer, &inner})
            for (const Line& ring : joiner->rings)
                write_ring(osm, next++, ring, relation.tags);
    }
    // Whatever the encoding: bytes stay as they are.
    std::ostringstream text;
    text << declaration(xml);
    document.save(text, "", pugi::format_raw | pugi::format_no_declaration);
    if (next != first_ring)
        found.osm = std::move(text).str();
    return found;
}

}  // namespace reprise::towns

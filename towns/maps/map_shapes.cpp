#include "towns/maps/map_shapes.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/maps/map_rings.h"
#include "towns/maps/netconvert.h"
#include "towns/network/network_xml.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

constexpr double neighbourhood = 350;  ///< [m] from the network: farther things are left out

constexpr const char* wanted_keys = R"(<polygonTypes>
<polygonType id="building" name="building"/>
<polygonType id="leisure" name="leisure"/>
<polygonType id="landuse" name="landuse"/>
<polygonType id="natural" name="natural"/>
<polygonType id="waterway" name="waterway"/>
<polygonType id="amenity" name="amenity"/>
<polygonType id="place" name="place"/>
<polygonType id="highway.pedestrian" name="highway"/>
<polygonType id="highway.stop" name="highway"/>
<polygonType id="highway.give_way" name="highway"/>
<polygonType id="highway.crossing" name="highway"/>
<polygonType id="layer" name="layer"/>
<polygonType id="bridge" name="bridge"/>
<polygonType id="tunnel" name="tunnel"/>
</polygonTypes>
)";

Tags tags_of(const pugi::xml_node& shape) {
    Tags tags;
    for (const pugi::xml_node param : shape.children("param"))
        tags[param.attribute("key").value()] = param.attribute("value").value();
    return tags;
}

void take(const pugi::xml_node& poly, std::set<std::string>& seen, MapShapes& shapes) {
    MapShape shape{
        poly.attribute("id").value(), tags_of(poly), parse_shape(poly.attribute("shape").value())};
    // What has two of the wanted keys comes twice, as ID and ID#1.
    const bool again = !seen.insert(shape.id.substr(0, shape.id.find('#'))).second;
    if (again || shape.line.size() < 2)
        return;
    const bool closed = shape.line.size() >= 4 && shape.line.front() == shape.line.back();
    if (closed && (is_building(shape.tags) || plot_kind(shape.tags)))
        shapes.areas.push_back(std::move(shape));
    else if (!tag_value(shape.tags, "highway").empty() && layer_of(shape.tags) != 0)
        shapes.ways.push_back(std::move(shape));
}

/// Points with another of the wanted keys are neither signs nor crossings.
void take_point(const pugi::xml_node& poi, MapShapes& shapes) {
    MapShape point{
        poi.attribute("id").value(),
        tags_of(poi),
        {{number(poi.attribute("x").value(), 0), number(poi.attribute("y").value(), 0), 0.0}}};
    const std::string kind = tag_value(point.tags, "highway");
    if (kind == "crossing")
        shapes.crossings.emplace_back(point.line.front().x(), point.line.front().y(), 0);
    else if (kind == "stop" || kind == "give_way")
        shapes.signs.push_back(std::move(point));
}

}  // namespace

int layer_of(const Tags& tags) {
    constexpr double farthest = 5;
    const double unsaid = farthest + 1;
    const double layer = number(tag_value(tags, "layer"), unsaid);
    if (std::abs(layer) <= farthest)
        return static_cast<int>(layer);
    const auto is = [&](const char* key) {
        const std::string value = tag_value(tags, key);
        return !value.empty() && value != "no";
    };
    if (is("bridge"))
        return 1;
    // A passage through a building lies at the height of the street.
    return is("tunnel") && tag_value(tags, "tunnel") != "building_passage" ? -1 : 0;
}

MapShapes read_shapes(const std::string& map,
                      const std::string& network,
                      const std::filesystem::path& scratch,
                      const std::string& called) {
    std::ofstream(scratch / "shapes.typ.xml") << wanted_keys;
    const MapRings rings = read_rings(scratch / map, called);
    std::ofstream(scratch / "rings.osm") << rings.osm;
    run_sumo_tool("polyconvert",
                  {"--net-file",
                   network,
                   "--osm-files",
                   rings.osm.empty() ? map : map + ",rings.osm",
                   "--type-file",
                   "shapes.typ.xml",
                   "--discard",
                   // Extracts have ways of which no node is left: netconvert has said so.
                   "--ignore-errors",
                   "--all-attributes",
                   "--osm.keep-full-type",
                   "--prune.in-net",
                   "--prune.in-net.offsets",
                   fmt::format("{0},{0},{0},{0}", neighbourhood),
                   "--precision",
                   "3",
                   "--output-file",
                   "shapes.xml"},
                  scratch,
                  called);
    pugi::xml_document document;
    if (!document.load_file((scratch / "shapes.xml").c_str()))
        throw world::Error(called + ": polyconvert wrote no shapes");
    MapShapes shapes;
    shapes.open_areas = rings.open;
    std::set<std::string> seen;
    for (const pugi::xml_node poly : document.document_element().children("poly"))
        take(poly, seen, shapes);
    for (const pugi::xml_node poi : document.document_element().children("poi"))
        take_point(poi, shapes);
    return shapes;
}

}  // namespace reprise::towns

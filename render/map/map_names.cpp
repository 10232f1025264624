#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "render/map/map_layers.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

constexpr double letter_height = 10;  ///< [pixels] of a sheet of 1600
constexpr std::size_t longest = 28;   ///< [characters]

/// Letters of Latin alphabets beyond ASCII, as two bytes of UTF-8 after 0xC3: our letters are
/// ASCII.
std::optional<std::string> plain_letter(unsigned char second) {
    static const std::map<unsigned char, const char*> letters{
        {0x84, "Ae"}, {0x96, "Oe"}, {0x9C, "Ue"}, {0xA4, "ae"}, {0xB6, "oe"}, {0xBC, "ue"},
        {0x9F, "ss"}, {0x80, "A"},  {0x81, "A"},  {0x82, "A"},  {0x83, "A"},  {0x85, "A"},
        {0x86, "Ae"}, {0x87, "C"},  {0x88, "E"},  {0x89, "E"},  {0x8A, "E"},  {0x8B, "E"},
        {0x8D, "I"},  {0x8E, "I"},  {0x91, "N"},  {0x93, "O"},  {0x94, "O"},  {0x98, "O"},
        {0x9A, "U"},  {0xA0, "a"},  {0xA1, "a"},  {0xA2, "a"},  {0xA3, "a"},  {0xA5, "a"},
        {0xA6, "ae"}, {0xA7, "c"},  {0xA8, "e"},  {0xA9, "e"},  {0xAA, "e"},  {0xAB, "e"},
        {0xAC, "i"},  {0xAD, "i"},  {0xAE, "i"},  {0xAF, "i"},  {0xB1, "n"},  {0xB2, "o"},
        {0xB3, "o"},  {0xB4, "o"},  {0xB5, "o"},  {0xB8, "o"},  {0xB9, "u"},  {0xBA, "u"},
        {0xBB, "u"},  {0xBD, "y"},  {0xBF, "y"}};
    const auto found = letters.find(second);
    return found == letters.end() ? std::nullopt : std::optional<std::string>(found->second);
}

/// None: in an alphabet that the map's letters do not have, or too long to be of use.
std::optional<std::string> writable(const std::string& name) {
    std::string plain;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto byte = static_cast<unsigned char>(name[i]);
        if (byte >= 0x20 && byte < 0x7F) {
            plain += name[i];
            continue;
        }
        const auto letter = byte == 0xC3 && i + 1 < name.size()
                                ? plain_letter(static_cast<unsigned char>(name[i + 1]))
                                : std::nullopt;
        if (!letter)
            return std::nullopt;
        plain += *letter;
        ++i;
    }
    if (plain.empty() || plain.size() > longest)
        return std::nullopt;
    return plain;
}

/// A road, with the place for its letters.
struct StreetName {
    std::optional<std::string> street;  ///< its name
    std::optional<std::string> edge;    ///< what scripts call it
    double length = 0;                  ///< [m]
    Eigen::Vector2d place;
    double angle = 0;  ///< [rad]
};

/// The lane of each edge that lies at the road's middle: the one that knows the other direction, or
/// else the edge's first.
std::map<std::string, const world::LaneT*> middle_lanes(const world::TownT& town) {
    std::map<std::string, const world::LaneT*> lanes;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving) {
            const world::LaneT*& middle = lanes[lane.edge];
            if (middle == nullptr || lane.opposite < town.lanes.size())
                middle = &lane;
        }
    return lanes;
}

/// Both directions of a road share a name, and the middle between them.
std::vector<StreetName> names_of_edges(const world::TownT& town) {
    std::vector<StreetName> names;
    std::set<std::string> seen;
    for (const auto& [edge, middle] : middle_lanes(town)) {
        if (!seen.insert(edge).second)
            continue;
        const world::LaneT& lane = *middle;
        world::LanePoint at = world::point_at(lane, lane.length / 2);
        if (lane.opposite < town.lanes.size()) {
            const world::LaneT& opposite = town.lanes[lane.opposite];
            seen.insert(opposite.edge);
            at.position =
                (at.position + world::point_at(opposite, opposite.length / 2).position) / 2;
        }
        // Letters stand upright.
        const double angle = world::wrap_angle(at.yaw);
        const bool upside_down = std::abs(angle) > std::numbers::pi / 2 + 1e-6;
        names.push_back({writable(lane.street),
                         writable(lane.edge),
                         lane.length,
                         at.position.head<2>(),
                         upside_down ? world::wrap_angle(angle + std::numbers::pi) : angle});
    }
    std::stable_sort(
        names.begin(), names.end(), [](const StreetName& one, const StreetName& other) {
            return one.length > other.length;
        });
    return names;
}

}  // namespace

void draw_names(const world::TownT& town, MapCanvas& canvas) {
    const double height = letter_height * canvas.unit();
    // Junctions first: there is little choice where their names go. Only where roads meet, and
    // where the name is hardly wider than the place itself.
    std::vector<bool> is_passed(town.junctions.size(), false);
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::internal && lane.junction < town.junctions.size())
            is_passed[lane.junction] = true;
    for (std::size_t i = 0; i < town.junctions.size(); ++i) {
        const world::JunctionT& junction = town.junctions[i];
        const auto text = writable(junction.name);
        if (!text || !is_passed[i] || junction.outline.empty())
            continue;
        const world::Box box = world::box_around(world::in_plan(junction.outline));
        const double room = (box.high - box.low).maxCoeff() * canvas.pixels_per_metre();
        if (canvas.text_width(*text, 0.95 * height) < 1.4 * room)
            canvas.label(*text, world::in_plan(junction.centre), 0, 0.95 * height);
    }
    // The longest of a street carries its name as well; others repeat it far from there only.
    constexpr double again = 450;  // [pixels] of a sheet of 1600
    std::map<std::string, std::vector<Eigen::Vector2d>> written;
    for (const StreetName& name : names_of_edges(town)) {
        const double room = 0.9 * name.length * canvas.pixels_per_metre();
        const auto write = [&](const std::string& text) {
            return canvas.text_width(text, height) <= room &&
                   canvas.label(text, name.place, name.angle, 0.85 * height);
        };
        if (name.street) {
            std::vector<Eigen::Vector2d>& places = written[*name.street];
            const bool is_near = std::any_of(places.begin(), places.end(), [&](const auto& other) {
                return (other - name.place).norm() * canvas.pixels_per_metre() <
                       again * canvas.unit();
            });
            if (!is_near &&
                ((name.edge && write(*name.street + "  " + *name.edge)) || write(*name.street))) {
                places.push_back(name.place);
                continue;
            }
        }
        if (name.edge)
            write(*name.edge);
    }
}

}  // namespace reprise::render

#include "towns/maps/opendrive_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "towns/network/out_of_place.h"
#include "world/check.h"

namespace reprise::towns {

namespace {

/// The range of an optional attribute.
struct Bound {
    const char* element;
    const char* attribute;
    double largest;  ///< magnitude
};

constexpr std::array bounds{
    Bound{"road", "length", 1e5},       // [m]
    Bound{"geometry", "length", 1e5},   // [m]
    Bound{"geometry", "s", 2e5},        // [m]
    Bound{"geometry", "x", 1e8},        // [m]
    Bound{"geometry", "y", 1e8},        // [m]
    Bound{"geometry", "hdg", 1e4},      // [rad]
    Bound{"arc", "curvature", 1e3},     // [1/m]
    Bound{"spiral", "curvStart", 1e3},  // [1/m]
    Bound{"spiral", "curvEnd", 1e3},    // [1/m]
    Bound{"elevation", "a", 1e4},       // [m]
    Bound{"width", "a", 100},           // [m] of a lane
    Bound{"border", "a", 200},          // [m]
    Bound{"laneOffset", "a", 200},      // [m]
    Bound{"signal", "s", 2e5},          // [m]
    Bound{"signal", "t", 1e4},          // [m]
};

class Checker : public pugi::xml_tree_walker {
  public:
    Checker(std::string_view xml, const std::string& file) : xml_(xml), file_(file) {}

    bool for_each(pugi::xml_node& node) override {
        constexpr int deepest = 1000;
        if (depth() > deepest)
            fail(node, fmt::format("elements are nested more than {} deep", deepest));
        for (const Bound& bound : bounds)
            if (std::string_view(node.name()) == bound.element)
                check(node, bound);
        return true;
    }

    /// netconvert makes a point every two metres of each lane, and towns are built over all of
    /// their ground.
    void check_size(const pugi::xml_node& root) const {
        constexpr std::ptrdiff_t most_lanes = 64;  // of a section
        constexpr double most = 1e7;               // [m] of all lanes together
        double total = 0;
        std::vector<Eigen::Vector2d> places;
        std::vector<pugi::xml_node> roads;
        for (const pugi::xml_node road : root.children("road")) {
            std::ptrdiff_t widest = 0;
            for (const pugi::xml_node section : road.child("lanes").children("laneSection")) {
                std::ptrdiff_t lanes = 0;
                for (const char* side : {"left", "center", "right"})
                    for (const pugi::xml_node part : section.children(side))
                        lanes += std::distance(part.begin(), part.end());
                if (lanes > most_lanes)
                    fail(section,
                         fmt::format("of road '{}' has {} lanes; {} at most are possible",
                                     road.attribute("id").value(),
                                     lanes,
                                     most_lanes));
                widest = std::max(widest, lanes);
            }
            total += static_cast<double>(widest) * number(road.attribute("length").value(), 0);
            if (total > most)
                fail(road,
                     fmt::format("'{}': with it, the lanes are longer than {:.0f} km together",
                                 road.attribute("id").value(),
                                 most / 1000));
            for (const pugi::xml_node piece : road.child("planView").children("geometry")) {
                places.emplace_back(number(piece.attribute("x").value(), 0),
                                    number(piece.attribute("y").value(), 0));
                roads.push_back(piece);
            }
        }
        if (const auto place = out_of_place(places))
            fail(roads[*place],
                 fmt::format("lies so far away that the town would be wider than {:.0f} km",
                             widest_town / 1000));
    }

  private:
    void check(const pugi::xml_node& node, const Bound& bound) const {
        const std::string_view text = node.attribute(bound.attribute).value();
        if (text.empty())
            return;
        const double not_a_number = std::numeric_limits<double>::infinity();
        const double value = number(text, not_a_number);
        if (!(std::abs(value) <= bound.largest))
            fail(node,
                 fmt::format("{}=\"{}\" is not a number up to {:.0f}",
                             bound.attribute,
                             text.substr(0, 40),
                             bound.largest));
    }

    [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const {
        throw world::Error(fmt::format("{}:{}: <{}>: {}",
                                       file_,
                                       line_of(xml_, static_cast<std::size_t>(node.offset_debug())),
                                       node.name(),
                                       what));
    }

    std::string_view xml_;
    const std::string& file_;
};

}  // namespace

void check_opendrive(const pugi::xml_node& root, std::string_view xml, const std::string& file) {
    Checker checker(xml, file);
    pugi::xml_node whole = root;
    whole.traverse(checker);
    checker.check_size(root);
}

}  // namespace reprise::towns

#include "towns/maps/opendrive_check.h"

#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
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
    Bound{"road", "length", 2e5},       // [m]
    Bound{"geometry", "length", 2e5},   // [m]
    Bound{"geometry", "s", 2e5},        // [m]
    Bound{"geometry", "x", 1e8},        // [m]
    Bound{"geometry", "y", 1e8},        // [m]
    Bound{"geometry", "hdg", 1e4},      // [rad]
    Bound{"arc", "curvature", 1e3},     // [1/m]
    Bound{"spiral", "curvStart", 1e3},  // [1/m]
    Bound{"spiral", "curvEnd", 1e3},    // [1/m]
    Bound{"elevation", "a", 1e4},       // [m]
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
}

}  // namespace reprise::towns

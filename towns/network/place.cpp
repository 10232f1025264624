#include "towns/network/place.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "towns/network/sign_words.h"
#include "world/check.h"
#include "world/models/building_models.h"
#include "world/units.h"
#include "world/words.h"

namespace reprise::towns {

namespace {

using world::PlotKind;
using world::Vec3;
using Outline = std::vector<Vec3>;

constexpr std::array<const char*, 5> district_styles{"village", "old", "brick", "modern", "centre"};

/// An element, and how to speak about it.
class Element {
  public:
    Element(pugi::xml_node node, std::string_view xml, const std::string& file)
        : node_(node),
          xml_(xml),
          file_(file) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw world::Error(
            fmt::format("{}:{}: <{}>: {}",
                        file_,
                        line_of(xml_, static_cast<std::size_t>(node_.offset_debug())),
                        node_.name(),
                        what));
    }

    std::string_view text(const char* name) const { return node_.attribute(name).value(); }

    /// 0 when it is left out.
    double real(const char* name) const {
        const std::string_view written = text(name);
        const double nothing = std::numeric_limits<double>::infinity();
        const double value = written.empty() ? 0 : number(written, nothing);
        if (value == nothing || std::abs(value) > 1e9)
            fail(fmt::format("{}=\"{}\" is not a number", name, written));
        return value;
    }

    std::uint32_t whole(std::string_view name, std::string_view written) const {
        std::uint32_t value = 0;
        const char* end = written.data() + written.size();
        const auto [stop, error] = std::from_chars(written.data(), end, value);
        if (!written.empty() && (error != std::errc() || stop != end))
            fail(fmt::format("{}: '{}' is not a whole number", name, written));
        return value;
    }

    /// Index in `names` of the word that an attribute holds.
    std::size_t word(const char* name, const std::vector<std::string>& names) const {
        const std::string written(text(name));
        const auto found = std::find(names.begin(), names.end(), written);
        if (found == names.end())
            fail(fmt::format(
                "{}=\"{}\" is unknown{}", name, written, world::did_you_mean(written, names)));
        return static_cast<std::size_t>(found - names.begin());
    }

    Vec3 position() const { return {real("x"), real("y"), real("z")}; }

    /// A polygon of three points at least.
    Outline shape() const {
        check_points();
        const double z = real("z");
        Outline outline;
        for (const Vec3& point : parse_shape(text("shape")))
            outline.emplace_back(point.x(), point.y(), point.z() + z);
        if (outline.size() < 3)
            fail("its shape needs three points at least, \"x,y x,y x,y\"");
        return outline;
    }

  private:
    void check_points() const {
        const double nothing = std::numeric_limits<double>::infinity();
        for (const std::string_view point : world::words(text("shape")))
            for (std::size_t from = 0, to = 0; to != std::string_view::npos; from = to + 1) {
                to = point.find(',', from);
                if (std::abs(number(point.substr(from, to - from), nothing)) > 1e9)
                    fail(fmt::format("'{}' in its shape is not a point", point));
            }
    }

    pugi::xml_node node_;
    std::string_view xml_;
    const std::string& file_;
};

template <typename Table>
std::vector<std::string> names_of(const Table& table) {
    std::vector<std::string> names;
    for (const auto& [name, kind] : table)
        names.emplace_back(name);
    return names;
}

Place::Head read_head(const Element& element) {
    Place::Head head;
    head.program = element.text("program");
    for (const std::string_view link : world::words(element.text("links")))
        head.links.push_back(element.whole("links", link));
    if (head.program.empty() || head.links.empty())
        element.fail("needs a program and its links");
    head.foot = element.position();
    head.yaw = element.real("yaw") * world::degree;
    head.height = element.real("height");
    head.arm = element.real("arm");
    return head;
}

world::Prop read_sign(const Element& element) {
    const std::size_t kind = element.word("kind", names_of(sign_words));
    const std::uint32_t value = element.whole("value", element.text("value"));
    if (value > 999)
        element.fail(fmt::format("value=\"{}\": expected km/h, 999 at most", value));
    return {element.position(),
            element.real("yaw") * world::degree,
            element.real("length"),
            element.real("width"),
            element.real("height"),
            element.whole("style", element.text("style")),
            static_cast<std::uint16_t>(value),
            sign_words[kind].second,
            0};
}

world::PlotT read_plot(const Element& element) {
    std::vector<std::string> names;
    for (const char* const* name = world::EnumNamesPlotKind(); *name != nullptr; ++name)
        names.emplace_back(*name);
    world::PlotT plot;
    plot.kind = static_cast<PlotKind>(element.word("kind", names));
    plot.outline = element.shape();
    return plot;
}

world::DrawnBuildingT read_building(const Element& element) {
    world::DrawnBuildingT building;
    building.outline = element.shape();
    building.height = element.real("height");
    if (building.height <= 0)
        element.fail("its height must be above 0");
    building.style = element.whole("style", element.text("style"));
    if (!element.text("model").empty()) {
        std::vector<std::string> names;
        for (const world::BuildingModel& model : world::building_models())
            names.emplace_back(model.name);
        building.model = static_cast<std::uint32_t>(element.word("model", names)) + 1;
    }
    return building;
}

Place::District read_district(const Element& element) {
    const std::vector<std::string> names(district_styles.begin(), district_styles.end());
    Place::District district;
    district.style = names[element.word("style", names)];
    if (!element.text("shape").empty())
        district.outline = element.shape();
    return district;
}

}  // namespace

Place read_place(std::string_view xml, const std::string& file) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(xml.data(), xml.size());
    const pugi::xml_node root = document.document_element();
    if (!parsed || std::string_view(root.name()) != "place")
        throw world::Error(fmt::format(
            "{}:{}: expected <place>: {}",
            file,
            line_of(xml, static_cast<std::size_t>(parsed.offset)),
            parsed ? "found <" + std::string(root.name()) + ">" : parsed.description()));
    Place place;
    for (const pugi::xml_node node : root.children()) {
        if (node.type() != pugi::node_element)
            continue;
        const Element element(node, xml, file);
        const std::string name = node.name();
        if (name == "head")
            place.heads.push_back(read_head(element));
        else if (name == "sign")
            place.signs.push_back(read_sign(element));
        else if (name == "plot")
            place.plots.push_back(read_plot(element));
        else if (name == "building")
            place.buildings.push_back(read_building(element));
        else if (name == "district")
            place.districts.push_back(read_district(element));
        else if (name == "keep_clear")
            place.keep_clear.push_back(element.shape());
        else
            element.fail("is unknown" +
                         world::did_you_mean(
                             name, {"head", "sign", "plot", "building", "district", "keep_clear"}));
    }
    return place;
}

}  // namespace reprise::towns

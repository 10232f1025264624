#include "towns/network/network_xml.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace reprise::traffic {

const std::vector<std::string_view>& vehicle_class_names() {
    // SUMO 1.15, src/utils/common/SUMOVehicleClass.cpp.
    static const std::vector<std::string_view> names{
        "passenger",     "private",   "taxi",       "bus",     "coach",    "delivery",   "truck",
        "trailer",       "emergency", "motorcycle", "moped",   "bicycle",  "pedestrian", "tram",
        "rail_electric", "rail_fast", "rail_urban", "rail",    "evehicle", "army",       "ship",
        "authority",     "vip",       "hov",        "custom1", "custom2"};
    return names;
}

ClassSet class_bit(std::string_view name) {
    const auto& names = vehicle_class_names();
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? 0 : ClassSet{1} << (found - names.begin());
}

namespace {

ClassSet class_set(std::string_view list) {
    const ClassSet all = (ClassSet{1} << vehicle_class_names().size()) - 1;
    ClassSet set = 0;
    for (const std::string_view word : words(list))
        set |= word == "all" ? all : class_bit(word);
    return set;
}

}  // namespace

ClassSet permitted(std::string_view allow, std::string_view disallow) {
    const ClassSet all = class_set("all");
    return allow.empty() ? all & ~class_set(disallow) : class_set(allow);
}

std::vector<std::string_view> words(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    std::vector<std::string_view> found;
    std::size_t start = text.find_first_not_of(blanks);
    while (start != std::string_view::npos) {
        const std::size_t end = std::min(text.find_first_of(blanks, start), text.size());
        found.push_back(text.substr(start, end - start));
        start = text.find_first_not_of(blanks, end);
    }
    return found;
}

double number(std::string_view text, double fallback) {
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
    return whole && std::isfinite(value) ? value : fallback;
}

std::vector<world::Vec3> parse_shape(std::string_view text) {
    std::vector<world::Vec3> points;
    for (const std::string_view point : words(text)) {
        const std::size_t first = std::min(point.find(','), point.size());
        const std::size_t second = std::min(point.find(',', first + 1), point.size());
        const double x = number(point.substr(0, first), 0);
        const double y =
            first < point.size() ? number(point.substr(first + 1, second - first - 1), 0) : 0;
        const double z = second < point.size() ? number(point.substr(second + 1), 0) : 0;
        const bool repeats =
            !points.empty() &&
            std::hypot(x - points.back().x(), y - points.back().y(), z - points.back().z()) < 1e-3;
        if (!repeats)
            points.emplace_back(x, y, z);
    }
    return points;
}

std::string junction_around(const std::string& edge) {
    return edge.substr(1, edge.rfind('_') - 1);
}

std::size_t line_of(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

}  // namespace reprise::traffic

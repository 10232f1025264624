#include "towns/network/network_xml.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "world/words.h"

namespace reprise::towns {

double number(std::string_view text, double fallback) {
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
    return whole && std::isfinite(value) ? value : fallback;
}

std::vector<world::Vec3> parse_shape(std::string_view text) {
    std::vector<world::Vec3> points;
    for (const std::string_view point : world::words(text)) {
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

}  // namespace reprise::towns

#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace reprise::towns {

using Tagged = std::vector<std::pair<std::string, std::string>>;

/// An OpenStreetMap map, written down in metres. Ids count up from 1.
class StreetMap {
  public:
    int node(double east, double north, const Tagged& tags = {}) {
        constexpr double metres_per_degree = 111'320;
        const double latitude = 51.45 + north / metres_per_degree;
        const double longitude =
            -2.59 + east / (metres_per_degree * std::cos(51.45 * std::numbers::pi / 180));
        nodes_ += fmt::format("<node id=\"{}\" lat=\"{:.7f}\" lon=\"{:.7f}\">{}</node>\n",
                              ++last_,
                              latitude,
                              longitude,
                              written(tags));
        return last_;
    }

    int way(const std::vector<int>& nodes, const Tagged& tags) {
        ways_ += fmt::format("<way id=\"{}\">", ++last_way_);
        for (const int node : nodes)
            ways_ += fmt::format("<nd ref=\"{}\"/>", node);
        ways_ += written(tags) + "</way>\n";
        return last_way_;
    }

    /// Of ways, each with its role.
    void multipolygon(const std::vector<std::pair<int, std::string>>& ways, const Tagged& tags) {
        relations_ += fmt::format("<relation id=\"{}\">", ++last_relation_);
        for (const auto& [way, role] : ways)
            relations_ += fmt::format("<member type=\"way\" ref=\"{}\" role=\"{}\"/>", way, role);
        relations_ += "<tag k=\"type\" v=\"multipolygon\"/>" + written(tags) + "</relation>\n";
    }

    std::string text() const {
        return "<osm version=\"0.6\">\n" + nodes_ + ways_ + relations_ + "</osm>\n";
    }

  private:
    static std::string written(const Tagged& tags) {
        std::string text;
        for (const auto& [key, value] : tags)
            text += fmt::format("<tag k=\"{}\" v=\"{}\"/>", key, value);
        return text;
    }

    int last_ = 0;
    int last_way_ = 0;
    int last_relation_ = 0;
    std::string nodes_, ways_, relations_;
};

}  // namespace reprise::towns

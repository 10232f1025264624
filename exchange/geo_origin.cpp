#include "exchange/geo_origin.h"

#include <cstdio>

#include <proj.h>

namespace reprise::exchange {

namespace {

/// The value of an attribute in the network's <location .../>; networks are large, and this one
/// element stands near their start.
std::string location_attribute(const std::string& network, const std::string& name) {
    const std::size_t begin = network.find("<location ");
    const std::size_t end = network.find('>', begin);
    if (begin == std::string::npos || end == std::string::npos)
        return "";
    const std::string element = network.substr(begin, end - begin);
    const std::size_t at = element.find(" " + name + "=\"");
    if (at == std::string::npos)
        return "";
    const std::size_t from = at + name.size() + 3;
    return element.substr(from, element.find('"', from) - from);
}

}  // namespace

Eigen::Vector2d net_offset(const std::string& network) {
    Eigen::Vector2d offset(0, 0);
    const std::string text = location_attribute(network, "netOffset");
    if (std::sscanf(text.c_str(), "%lf,%lf", &offset.x(), &offset.y()) != 2)
        return {0, 0};
    return offset;
}

struct GeoOrigin::Projection {
    PJ_CONTEXT* context = proj_context_create();
    PJ* projection = nullptr;
    double offset_x = 0;
    double offset_y = 0;

    Projection() { proj_log_level(context, PJ_LOG_NONE); }

    ~Projection() {
        proj_destroy(projection);
        proj_context_destroy(context);
    }

    Projection(const Projection&) = delete;
    Projection& operator=(const Projection&) = delete;
};

std::optional<GeoOrigin> GeoOrigin::of(const std::string& network) {
    const std::string text = location_attribute(network, "projParameter");
    if (!text.starts_with("+proj"))
        return std::nullopt;  // "!": none; "-", ".": simple ones without a name
    auto made = std::make_unique<Projection>();
    if (location_attribute(network, "netOffset").empty())
        return std::nullopt;
    const Eigen::Vector2d offset = net_offset(network);
    made->offset_x = offset.x();
    made->offset_y = offset.y();
    made->projection = proj_create(made->context, text.c_str());
    if (made->projection == nullptr)
        return std::nullopt;
    return GeoOrigin(std::move(made));
}

GeoOrigin::GeoOrigin(std::unique_ptr<Projection> projection) : projection_(std::move(projection)) {}

GeoOrigin::~GeoOrigin() = default;
GeoOrigin::GeoOrigin(GeoOrigin&&) noexcept = default;
GeoOrigin& GeoOrigin::operator=(GeoOrigin&&) noexcept = default;

Geodetic GeoOrigin::at(const world::Vec3& position) const {
    const PJ_COORD plane = proj_coord(
        position.x() - projection_->offset_x, position.y() - projection_->offset_y, 0, 0);
    const PJ_COORD globe = proj_trans(projection_->projection, PJ_INV, plane);
    return {proj_todeg(globe.lp.phi), proj_todeg(globe.lp.lam)};
}

}  // namespace reprise::exchange

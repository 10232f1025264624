#include "towns/maps/reference_line.h"

#include <algorithm>
#include <cmath>

#include <pugixml.hpp>

#include "towns/network/network_xml.h"

namespace reprise::towns {

namespace {

double real_attribute(const pugi::xml_node& node, const char* name, double fallback = 0) {
    return number(node.attribute(name).value(), fallback);
}

double polynomial(const double (&c)[4], double p) {
    return c[0] + p * (c[1] + p * (c[2] + p * c[3]));
}

double slope(const double (&c)[4], double p) {
    return c[1] + p * (2 * c[2] + p * 3 * c[3]);
}

/// From the frame of a pose into the map.
RoadPose placed(const RoadPose& start, double u, double v, double turn) {
    const double c = std::cos(start.heading), s = std::sin(start.heading);
    return {start.position + Eigen::Vector2d(c * u - s * v, s * u + c * v), start.heading + turn};
}

}  // namespace

ReferenceLine::ReferenceLine(const pugi::xml_node& plan_view) {
    for (const pugi::xml_node geometry : plan_view.children("geometry"))
        pieces_.push_back(read(geometry));
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& left, const Piece& right) {
        return left.s < right.s;
    });
}

ReferenceLine::Piece ReferenceLine::read(const pugi::xml_node& geometry) {
    Piece piece;
    piece.s = real_attribute(geometry, "s");
    piece.length = real_attribute(geometry, "length");
    piece.start = {{real_attribute(geometry, "x"), real_attribute(geometry, "y")},
                   real_attribute(geometry, "hdg")};
    if (const pugi::xml_node arc = geometry.child("arc")) {
        piece.kind = Kind::arc;
        piece.curvature_start = piece.curvature_end = real_attribute(arc, "curvature");
    } else if (const pugi::xml_node spiral = geometry.child("spiral")) {
        piece.kind = Kind::spiral;
        piece.curvature_start = real_attribute(spiral, "curvStart");
        piece.curvature_end = real_attribute(spiral, "curvEnd");
    } else if (const pugi::xml_node poly = geometry.child("poly3")) {
        piece.kind = Kind::poly3;
        const char* names[] = {"a", "b", "c", "d"};
        for (int i = 0; i < 4; ++i)
            piece.v[i] = real_attribute(poly, names[i]);
    } else if (const pugi::xml_node param = geometry.child("paramPoly3")) {
        piece.kind = Kind::param_poly3;
        const char* u[] = {"aU", "bU", "cU", "dU"};
        const char* v[] = {"aV", "bV", "cV", "dV"};
        for (int i = 0; i < 4; ++i) {
            piece.u[i] = real_attribute(param, u[i]);
            piece.v[i] = real_attribute(param, v[i]);
        }
        piece.normalised = std::string_view(param.attribute("pRange").value()) != "arcLength";
    }
    return piece;
}

RoadPose ReferenceLine::at(double s) const {
    if (pieces_.empty())
        return {};
    const Piece* piece = &pieces_.front();
    for (const Piece& next : pieces_)
        if (next.s <= s)
            piece = &next;
    const double ds = std::clamp(s - piece->s, 0.0, std::max(piece->length, 0.0));
    const bool polynomial = piece->kind == Kind::poly3 || piece->kind == Kind::param_poly3;
    return polynomial ? along_polynomial(*piece, ds) : along_curve(*piece, ds);
}

/// Curvature grows linearly, so the turn is a quadratic in s; the place is its cosine and sine,
/// integrated by Simpson's rule in steps of half a metre: exact for a line, 1e-8 m for R = 10 m.
RoadPose ReferenceLine::along_curve(const Piece& piece, double ds) {
    const double growth =
        piece.length > 0 ? (piece.curvature_end - piece.curvature_start) / piece.length : 0;
    const auto turn = [&](double at) { return at * (piece.curvature_start + at * growth / 2); };
    constexpr double longest_step = 0.5, most_steps = 20'000;
    const int steps = static_cast<int>(std::clamp(std::ceil(ds / longest_step), 1.0, most_steps));
    const double h = ds / steps;
    double u = 0, v = 0;
    for (int i = 0; i < steps; ++i) {
        const double first = turn(i * h), middle = turn((i + 0.5) * h), last = turn((i + 1) * h);
        u += h / 6 * (std::cos(first) + 4 * std::cos(middle) + std::cos(last));
        v += h / 6 * (std::sin(first) + 4 * std::sin(middle) + std::sin(last));
    }
    return placed(piece.start, u, v, turn(ds));
}

RoadPose ReferenceLine::along_polynomial(const Piece& piece, double ds) {
    double p = ds;
    if (piece.normalised) {
        p = piece.length > 0 ? ds / piece.length : 0;
    } else if (piece.kind == Kind::poly3) {
        // v is a function of u, not of the length along the curve: go there in small steps.
        constexpr int steps = 200;
        p = 0;
        for (int i = 0; i < steps; ++i) {
            const double half = p + ds / steps / 2 / std::hypot(1.0, slope(piece.v, p));
            p += ds / steps / std::hypot(1.0, slope(piece.v, half));
        }
    }
    const double turn = std::atan2(slope(piece.v, p), slope(piece.u, p));
    return placed(piece.start, polynomial(piece.u, p), polynomial(piece.v, p), turn);
}

}  // namespace reprise::towns

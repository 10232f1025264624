#pragma once

#include <vector>

#include <Eigen/Core>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// A place on a road's reference line.
struct RoadPose {
    Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< [m] in the map's coordinates
    double heading = 0;  ///< [rad] the way s grows, counter-clockwise from +x
};

/// The reference line of an OpenDRIVE road (ASAM OpenDRIVE 1.4 to 1.8, chapter "Geometry"): lines,
/// arcs, clothoids and cubic polynomials, one after the other along s.
class ReferenceLine {
  public:
    /// Out of a <planView>. A piece of a kind that is not known counts as a line.
    explicit ReferenceLine(const pugi::xml_node& plan_view);

    /// At s [m], which is clamped to the line. A line without pieces lies at the origin.
    RoadPose at(double s) const;

  private:
    enum class Kind { line, arc, spiral, poly3, param_poly3 };

    struct Piece {
        double s = 0;
        double length = 0;
        RoadPose start;
        Kind kind = Kind::line;
        double curvature_start = 0;  ///< [1/m] arc, spiral
        double curvature_end = 0;    ///< [1/m]
        double u[4] = {0, 1, 0, 0};  ///< polynomials of p, in the frame of the piece's start
        double v[4] = {0, 0, 0, 0};
        bool normalised = false;  ///< p runs from 0 to 1, not to the length
    };

    static Piece read(const pugi::xml_node& geometry);
    static RoadPose along_curve(const Piece& piece, double ds);
    static RoadPose along_polynomial(const Piece& piece, double ds);

    std::vector<Piece> pieces_;
};

}  // namespace reprise::towns

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "drivers/control/band_equations.h"
#include "drivers/control/ego.h"
#include "drivers/control/lateral_clearance.h"
#include "drivers/way/path.h"
#include "world/digest.h"
#include "world/models/catalogue.h"

namespace reprise::drivers {

/// Where the rear axle of a long vehicle should run, and how the body stands there.
struct WideTurnPoint {
    Eigen::Vector2d position;  ///< world, in plan, of the rear axle's middle
    double yaw = 0;            ///< [rad] of the body, unwrapped along the path
    double curvature = 0;      ///< [1/m] of the rear axle's track
    double squared_speed = 0;  ///< [m^2/s^2] that the turning allows, and braking towards it
};

/// How a long vehicle takes its bends. On a circle of radius R the rear axle of a wheelbase L runs
/// on sqrt(R^2 - L^2) when the front axle runs on R: a bus that keeps its middle on the lane puts
/// its rear wheels on the inner kerb of a corner and its front corner over the outer one. Bus
/// drivers swing wide, across the centre line if they must.
///
/// MUST    keep the whole footprint off kerbs and off what stands behind them; ask no more of the
///         steering than it can give; stay on the road, and off lanes that others wait on before
///         the junction, where that leaves a choice; else keep the middle between the axles on the
///         path, as the driver of a car does.
/// ASSUMES no slip: the body lies along the tangent of the rear axle's track. At a bus driver's
///         speeds the tyres make less than 2 degrees of it.
/// GOES    one number a sample, how far the rear axle runs left of the path, so that a sum of
///         squares is least (Levenberg and Marquardt; a band matrix): what is over kerbs, curvature
///         beyond the steering's, change of curvature, the middle's distance from the path.
/// KEEPS   what it saw beside the path, for the samples that come again: the plan is a function of
///         town, path and where the vehicle is.
class WideTurnPlan {
  public:
    /// Do bends need a plan? Cars fit into their lanes as they are.
    static bool is_needed(const world::VehicleModel& model) { return model.wheelbase > 3.3; }

    /// Both must outlive this.
    WideTurnPlan(const world::VehicleModel& model, const LateralClearances& clearances);
    ~WideTurnPlan();

    /// Plans from where the vehicle is to the end of the path. About 8 ms for 200 m.
    void plan(const Path& path, const Ego& ego);

    /// Is there a plan? Not when the path ends within some metres.
    bool empty() const { return points_.empty(); }

    /// Interpolated; s as in the path, clamped. Not when empty.
    WideTurnPoint at(double s) const;

    /// What the footprint sweeps, one for each sample of the path.
    std::span<const SweptWidth> swept() const { return swept_; }

    void add_to(world::Hasher& hasher) const;

  private:
    struct Station;
    struct Corner;

    void look_around(const Path& path, double rear_axle_s);
    void start_here(const Ego& ego);
    BandEquations equations_at(const Eigen::VectorXd& offsets);
    void place(const Eigen::VectorXd& offsets);
    void add_track(BandEquations& equations) const;
    void add_footprint(BandEquations& equations) const;
    void add_middle(BandEquations& equations, std::size_t station) const;
    void add_corner(BandEquations& equations, const Corner& corner) const;
    Corner corner(std::size_t station, double ahead, double left) const;
    template <typename Visit>
    void for_each_corner(Visit&& visit) const;
    std::size_t nearest(const Eigen::Vector2d& p, std::size_t guess) const;
    void finish();
    void sweep(const Path& path);

    const world::VehicleModel* model_;
    const LateralClearances* clearances_;
    std::vector<Station> stations_;  ///< samples of the path
    std::vector<WideTurnPoint> points_;
    std::vector<SweptWidth> swept_;
    std::vector<double> driven_;  ///< [m] offsets of the first stations, which are settled
    double start_ = 0;            ///< s of the first station
};

}  // namespace reprise::drivers

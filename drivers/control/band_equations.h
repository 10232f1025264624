#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace reprise::drivers {

/// Normal equations of a least sum of squares over numbers in a row, where each residual depends on
/// a few neighbours only. Collects one residual after another; memory and time are linear.
class BandEquations {
  public:
    /// Most neighbours that a residual depends on.
    static constexpr std::size_t width = 4;

    explicit BandEquations(std::size_t count)
        : band_(count),
          slope_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count))) {}

    /// A residual with its derivatives by the numbers first, first + 1, ...; `error` is how large
    /// a residual counts as one.
    template <std::size_t count>
    void add(std::size_t first,
             const std::array<double, count>& change,
             double residual,
             double error) {
        static_assert(count <= width);
        const double weight = 1 / (error * error);
        sum_ += weight * residual * residual;
        for (std::size_t i = 0; i < count; ++i) {
            slope_[static_cast<Eigen::Index>(first + i)] += weight * change[i] * residual;
            for (std::size_t k = 0; k <= i; ++k)
                band_[first + i][i - k] += weight * change[i] * change[k];
        }
    }

    /// Of the squares, so far.
    double sum() const { return sum_; }

    /// The step of the numbers towards the least sum; `damping` (Levenberg's, > 0) shortens it.
    Eigen::VectorXd solve(double damping) const;

  private:
    std::vector<std::array<double, width>> band_;  ///< [row][columns before the diagonal]
    Eigen::VectorXd slope_;
    double sum_ = 0;
};

}  // namespace reprise::drivers

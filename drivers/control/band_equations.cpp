#include "drivers/control/band_equations.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace reprise::drivers {

Eigen::VectorXd BandEquations::solve(double damping) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(band_.size() * width);
    for (std::size_t i = 0; i < band_.size(); ++i)
        for (std::size_t k = 0; k <= std::min(i, width - 1); ++k)
            entries.emplace_back(
                static_cast<int>(i), static_cast<int>(i - k), band_[i][k] + (k == 0 ? damping : 0));
    const auto size = static_cast<Eigen::Index>(band_.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    // The natural order keeps the band a band.
    const Eigen::
        SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>
            solver(matrix);
    return solver.solve(-slope_);
}

}  // namespace reprise::drivers

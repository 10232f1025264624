#include "drivers/control/band_equations.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "world/random.h"

namespace reprise::test {
namespace {

TEST(BandEquations, StepIsThatOfADenseLeastSquares) {
    constexpr std::size_t count = 12;
    const auto number = [](std::uint64_t row, std::uint64_t item) {
        return 2 * world::draw(7, row, world::Purpose::scenario, item) - 1;
    };
    drivers::BandEquations band(count);
    Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(40, count);
    Eigen::VectorXd residuals(40);
    double sum = 0;
    for (int row = 0; row < 40; ++row) {
        const std::size_t first = static_cast<std::size_t>(row) % (count - 3);
        const double error = 0.5 + std::abs(number(static_cast<std::uint64_t>(row), 9));
        std::array<double, 4> change{};
        for (std::size_t k = 0; k < 4; ++k) {
            change[k] = number(static_cast<std::uint64_t>(row), k);
            changes(row, static_cast<Eigen::Index>(first + k)) = change[k] / error;
        }
        band.add(first, change, number(static_cast<std::uint64_t>(row), 5), error);
        residuals[row] = number(static_cast<std::uint64_t>(row), 5) / error;
        sum += residuals[row] * residuals[row];
    }
    EXPECT_NEAR(band.sum(), sum, 1e-12);
    const Eigen::VectorXd dense = changes.colPivHouseholderQr().solve(-residuals);
    EXPECT_LT((band.solve(1e-12) - dense).norm(), 1e-8);
    EXPECT_LT(band.solve(100).norm(), 0.2 * dense.norm()) << "damping";
}

}  // namespace
}  // namespace reprise::test

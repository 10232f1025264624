#include "render/look/wet.h"

#include <cmath>

#include <gtest/gtest.h>

namespace reprise::render {
namespace {

/// What a dielectric throws back of light that comes evenly from everywhere, out of the medium with
/// the index `from`, by Fresnel's formulas.
double diffuse_reflectance(double from, double to) {
    double sum = 0;
    constexpr int steps = 20'000;
    for (int i = 0; i < steps; ++i) {
        const double angle = (i + 0.5) * M_PI / 2 / steps;
        const double sine = from / to * std::sin(angle);
        double thrown = 1;
        if (sine < 1) {
            const double inside = std::cos(std::asin(sine));
            const double outside = std::cos(angle);
            const double s = (from * outside - to * inside) / (from * outside + to * inside);
            const double p = (from * inside - to * outside) / (from * inside + to * outside);
            thrown = (s * s + p * p) / 2;
        }
        sum += thrown * std::sin(2 * angle) * M_PI / 2 / steps;
    }
    return sum;
}

TEST(WetAlbedo, IsThatOfLightKeptInAFilmOfWater) {
    const double kept_in = diffuse_reflectance(1.33, 1);
    const double thrown_back = diffuse_reflectance(1, 1.33);
    for (const double dry : {0.05, 0.1, 0.2, 0.5, 0.8}) {
        // From the film onto the surface and back again, once, twice, ...
        double sum = 0;
        double left = 1 - thrown_back;
        for (int bounce = 0; bounce < 200; ++bounce) {
            left *= dry;
            sum += left * (1 - kept_in);
            left *= kept_in;
        }
        const auto albedo = static_cast<float>(dry);
        EXPECT_NEAR(static_cast<double>(wet_albedo(Color::Constant(albedo)).x()), sum, 0.003)
            << dry;
    }
    EXPECT_NEAR(wet_albedo(Color::Constant(0.1F)).x() / 0.1F, 0.518F, 0.002F) << "asphalt";
}

TEST(WetAlbedo, IsDarkerByTheShareThatIsSoaked) {
    const Color dry(0.1F, 0.3F, 0.8F);
    const Color wanted = 0.75F * dry + 0.25F * wet_albedo(dry);
    const Color found = soaked(dry, 0.25F);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(found[channel], wanted[channel], 1e-6F) << channel;
}

}  // namespace
}  // namespace reprise::render

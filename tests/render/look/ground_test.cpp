#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "render/look/look.h"
#include "render/shapes/noise.h"
#include "tests/render/frames.h"
#include "world/weather/weather_text.h"

namespace reprise::render {
namespace {

constexpr float step = 0.005F;  // [m] between places of a plan
constexpr int side = 900;       // of a plan [places]

/// Dry asphalt from above.
class Asphalt {
  public:
    float tone(float x, float y, float footprint) const {
        Surface at{};
        at.position = {x, y, 0};
        at.flat = at.normal = at.local_normal = Eigen::Vector3f::UnitZ();
        at.view = -Eigen::Vector3f::UnitZ();
        at.footprint = footprint;
        at.material = Material::asphalt;
        return ground_look({scene_, sky_, 0}, at).albedo.y();
    }

    /// [0, 1] how deep the crack is there: by what a pixel loses that is just small enough for
    /// cracks, but not for stones, beside one that is too large for both.
    float crack(float x, float y) const {
        return (1 - tone(x, y, 0.032F) / tone(x, y, 0.054F)) / 0.36F;
    }

  private:
    TownScene town_{test::straight_road(400), false};
    Scene scene_{town_};
    Sky sky_{world::read_weather("clear_noon").weather};
};

/// Where the road is most cracked: the corner of a plan whose worst place is the best of many.
Eigen::Vector2f most_cracked() {
    Eigen::Vector2f best = Eigen::Vector2f::Zero();
    float most = 0;
    for (int i = 0; i < 200 * 200; ++i) {
        const Eigen::Vector2f corner(static_cast<float>(i % 200) * 2,
                                     static_cast<float>(i / 200) * 2);
        float least = 1;
        for (int j = 0; j < 9; ++j) {
            const Eigen::Vector2f at =
                corner + Eigen::Vector2f(static_cast<float>(j % 3), static_cast<float>(j / 3)) *
                             (side * step / 2);
            least = std::min(least, fractal_noise(at.x() * 0.13F, at.y() * 0.13F, 2, 30));
        }
        if (least > most) {
            most = least;
            best = corner;
        }
    }
    EXPECT_GT(most, 0.62F) << "no place of the plan is without cracks";
    return best;
}

/// Which places are broken, in rows.
std::vector<bool> plan_of_cracks(const Eigen::Vector2f& corner) {
    const Asphalt asphalt;
    std::vector<bool> broken(side * side);
    for (std::size_t i = 0; i < broken.size(); ++i)
        broken[i] = asphalt.crack(corner.x() + step * static_cast<float>(i % side),
                                  corner.y() + step * static_cast<float>(i / side)) > 0.3F;
    return broken;
}

/// Sizes of what cracks enclose, without what reaches out of the plan. [places]
std::vector<std::size_t> enclosed(std::vector<bool> reached) {
    std::vector<std::size_t> sizes;
    for (std::size_t start = 0; start < reached.size(); ++start) {
        if (reached[start])
            continue;
        bool inside = true;
        std::vector<std::size_t> piece{start};
        reached[start] = true;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const std::size_t x = piece[i] % side;
            const std::size_t y = piece[i] / side;
            if (x == 0 || y == 0 || x == side - 1 || y == side - 1) {
                inside = false;
                continue;
            }
            for (const std::size_t next :
                 {piece[i] - 1, piece[i] + 1, piece[i] - side, piece[i] + side})
                if (!reached[next]) {
                    reached[next] = true;
                    piece.push_back(next);
                }
        }
        if (inside)
            sizes.push_back(piece.size());
    }
    return sizes;
}

/// A noise that crosses a level makes knots and loops of a hand's width.
TEST(CracksOfRoads, PartTheGroundIntoPlatesAndNeverCurl) {
    const std::vector<bool> broken = plan_of_cracks(most_cracked());
    const auto all = static_cast<double>(std::count(broken.begin(), broken.end(), true));
    // Borders of plates 1.54 m wide: 1.3 m of them on a square metre, up to 3 cm wide.
    EXPECT_GT(all / side / side, 0.005);
    EXPECT_LT(all / side / side, 0.04);
    std::size_t large = 0;
    for (const std::size_t size : enclosed(broken)) {
        const double area = static_cast<double>(static_cast<float>(size) * step * step);
        // What is smaller than a hand is a place between stones.
        EXPECT_GT(area, 0.3) << "[m^2]";
        ++large;
    }
    EXPECT_GE(large, 1U) << "not even one plate is whole";
}

}  // namespace
}  // namespace reprise::render

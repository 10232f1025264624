#include "render/scene/crowd_map.h"

#include <random>

#include <gtest/gtest.h>

namespace reprise::render {
namespace {

/// Two kilometres, more than the map tells apart.
double place(std::mt19937& draw) {
    return static_cast<double>(draw() % 2'000'000) * 1e-3 - 1000;
}

TEST(CrowdMap, EveryPlaceFromWhichAShortRayReachesSomebodyIsNear) {
    std::mt19937 draw(17);
    std::size_t far = 0;
    for (int crowd = 0; crowd < 20; ++crowd) {
        CrowdMap map;
        map.fill(false);
        std::vector<std::pair<Eigen::Vector3d, double>> balls;
        for (int i = 0; i < 30; ++i) {
            balls.emplace_back(Eigen::Vector3d(place(draw), place(draw), 0),
                               0.1 * static_cast<double>(draw() % 90));
            map.add(balls.back().first, balls.back().second);
        }
        for (int i = 0; i < 20'000; ++i) {
            // Around somebody, and anywhere.
            const Eigen::Vector3d about = balls[draw() % balls.size()].first;
            Eigen::Vector3d at(place(draw), place(draw), 0);
            if (i % 2 == 0)
                at = about + 0.012 * at;
            bool reached = false;
            for (const auto& [middle, radius] : balls)
                reached |= (at - middle).norm() <= radius + double{CrowdMap::reach};
            const bool near = map.is_near(static_cast<float>(at.x()), static_cast<float>(at.y()));
            EXPECT_TRUE(near || !reached) << at.transpose();
            far += near ? 0 : 1;
        }
    }
    EXPECT_GT(far, 100'000) << "it says that somebody is everywhere";
}

}  // namespace
}  // namespace reprise::render

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <tbb/parallel_for_each.h>

#include "render/shade/shading_job.h"
#include "tests/render/frames.h"

namespace reprise::render {
namespace {

using Corner = Eigen::Vector2i;

Camera camera_of(int width, int height) {
    world::SensorSpec spec = test::camera(world::SensorKind::rgb, {0, 0, 0});
    spec.width = static_cast<std::uint16_t>(width);
    spec.height = static_cast<std::uint16_t>(height);
    return Camera(spec, Eigen::Isometry3d::Identity());
}

std::vector<Corner> corners_of(int width, int height) {
    std::vector<Corner> corners;
    for (int y = 0; y < height; y += tile)
        for (int x = 0; x < width; x += tile)
            corners.emplace_back(x, y);
    return corners;
}

struct Size {
    int width;
    int height;
};

const Size sizes[] = {{1, 1}, {tile, tile}, {5 * tile, 1}, {1, 4 * tile + 1}, {203, 117}};

TEST(TileStage, EachTileGoesOnOnceAndBehindItselfAndAllItsNeighbours) {
    for (const Size& size : sizes) {
        std::vector<Corner> corners = corners_of(size.width, size.height);
        std::shuffle(corners.begin(), corners.end(), std::mt19937(7));
        TileStage stage(camera_of(size.width, size.height));
        std::vector<Corner> finished, gone_on;
        for (const Corner& corner : corners) {
            finished.push_back(corner);
            stage.finish(corner, [&](const Corner& next) {
                gone_on.push_back(next);
                const auto near =
                    std::count_if(corners.begin(), corners.end(), [&](const Corner& other) {
                        return (other - next).cwiseAbs().maxCoeff() <= tile;
                    });
                const auto past =
                    std::count_if(finished.begin(), finished.end(), [&](const Corner& other) {
                        return (other - next).cwiseAbs().maxCoeff() <= tile;
                    });
                EXPECT_EQ(past, near) << next.transpose() << " of " << size.width;
            });
        }
        EXPECT_THAT(gone_on, testing::UnorderedElementsAreArray(corners));
    }
}

TEST(TileStage, ManyThreadsLetEachTileGoOnOnce) {
    const std::vector<Corner> corners = corners_of(640, 480);
    for (int round = 0; round < 20; ++round) {
        TileStage stage(camera_of(640, 480));
        std::vector<std::atomic<int>> times(corners.size());
        tbb::parallel_for_each(corners.begin(), corners.end(), [&](const Corner& corner) {
            stage.finish(corner, [&](const Corner& next) {
                const auto at = std::find(corners.begin(), corners.end(), next);
                ++times[static_cast<std::size_t>(at - corners.begin())];
            });
        });
        EXPECT_THAT(times, testing::Each(testing::Eq(1)));
    }
}

}  // namespace
}  // namespace reprise::render

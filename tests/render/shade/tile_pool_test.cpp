#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "render/shade/shading_job.h"
#include "tests/render/frames.h"

namespace reprise::render {
namespace {

TEST(TilePool, GivesWhatWasGivenBackFirst) {
    TilePool pool;
    TilePixels* first = pool.take();
    TilePixels* second = pool.take();
    EXPECT_NE(first, second);
    pool.give_back(first);
    EXPECT_EQ(pool.take(), first);
    EXPECT_EQ(pool.size(), 2U);
}

TEST(TilePool, HasAllAgainBehindAPictureThatWasBrokenOff) {
    TilePool pool;
    for (int picture = 0; picture < 3; ++picture) {
        pool.recall();
        pool.take();
        pool.give_back(pool.take());
    }
    EXPECT_EQ(pool.size(), 2U);
}

TEST(TilePool, AThreadNeedsASixthOfAPicturesTilesForAnyNumberOfPictures) {
    const TownScene town(test::straight_road(200), false);
    Scene scene(town);
    world::TickDraft draft;
    const world::SealedTick tick = world::seal(draft, {});
    scene.place(tick.view(), {});
    world::SensorSpec spec = test::camera(world::SensorKind::rgb);
    spec.width = 800;
    spec.height = 600;
    const Camera camera(spec, Eigen::Isometry3d::Identity());
    Sky sky(test::noon());
    sky.look_from(camera.position().cast<float>(), town.ground(), 0);
    const std::uint32_t all = scene.mask_hiding(0);
    std::vector<Hit> hits;
    Frame frame;
    tbb::task_arena one(1);
    for (int picture = 0; picture < 3; ++picture)
        one.execute([&] {
            trace_primary(scene, camera, all, hits);
            shade({scene, sky, 0}, camera, all, hits, frame);
        });
    EXPECT_LE(frame.pool.size(), TileStage(camera).tiles() / 6);
}

}  // namespace
}  // namespace reprise::render

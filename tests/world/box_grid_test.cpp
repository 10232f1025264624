#include <algorithm>

#include <gmock/gmock.h>

#include "world/geometry2d.h"
#include "world/random.h"

namespace reprise::world {

TEST(BoxGrid, AtAPlaceIsEverythingThatLiesThere) {
    auto drawn = [count = 0U](double low, double high) mutable {
        return low + (high - low) * draw(7, 0, Purpose::camera_noise, count++);
    };
    std::vector<BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < 300; ++i) {
        Box box;
        box.take(Eigen::Vector2d(drawn(-90, 90), drawn(-40, 40)), drawn(0, 9));
        entries.push_back({box, i});
    }
    const BoxGrid grid(entries, 4);
    for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector2d p(drawn(-120, 120), drawn(-60, 60));
        const auto there = grid.at(p);
        EXPECT_TRUE(std::is_sorted(there.begin(), there.end()));
        Box place;
        place.take(p);
        EXPECT_THAT(there, testing::ElementsAreArray(grid.near(place)));
        for (const BoxGrid::Entry& entry : entries) {
            const bool is_there = (entry.box.low.array() <= p.array()).all() &&
                                  (p.array() <= entry.box.high.array()).all();
            EXPECT_TRUE(!is_there ||
                        std::find(there.begin(), there.end(), entry.item) != there.end());
        }
    }
    EXPECT_TRUE(BoxGrid().at({3, 4}).empty());
}

TEST(BoxGrid, AnswersAreAscendingAndWithoutRepeatsHoweverEntriesCome) {
    Box here;
    here.take(Eigen::Vector2d(1, 1), 0.5);
    Box far;
    far.take(Eigen::Vector2d(50, 50), 0.5);
    const BoxGrid grid({{here, 5}, {far, 9}, {here, 2}, {far, 9}, {here, 5}, {here, 4}}, 4);
    EXPECT_THAT(grid.at({1, 1}), testing::ElementsAre(2, 4, 5));
    EXPECT_THAT(grid.at({50, 50}), testing::ElementsAre(9));
    EXPECT_THAT(grid.near(here), testing::ElementsAre(2, 4, 5));
    EXPECT_TRUE(grid.at({20, 20}).empty());
}

}  // namespace reprise::world

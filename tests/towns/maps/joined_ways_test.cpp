#include "towns/maps/joined_ways.h"

#include <algorithm>
#include <numeric>
#include <random>

#include <gmock/gmock.h>

namespace reprise::towns {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

JoinedWays join(const std::vector<NodeIds>& ways) {
    std::vector<const NodeIds*> pointers;
    for (const NodeIds& way : ways)
        pointers.push_back(&way);
    return join_ways(pointers);
}

/// Each begins with its least node, and goes on to the lesser of that one's neighbours.
std::vector<NodeIds> turned(std::vector<NodeIds> rings) {
    for (NodeIds& ring : rings) {
        ring.pop_back();
        std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
        if (ring.back() < ring[1])
            std::reverse(ring.begin() + 1, ring.end());
    }
    std::sort(rings.begin(), rings.end());
    return rings;
}

TEST(JoinedWays, CloseInEitherDirectionAndBeginAsTheFirst) {
    const JoinedWays joined = join({{1, 2, 3}, {5, 4, 3}, {5, 6, 1}});
    EXPECT_TRUE(joined.all_close);
    EXPECT_THAT(joined.rings, ElementsAre(NodeIds{1, 2, 3, 4, 5, 6, 1}));
}

TEST(JoinedWays, OfSeveralRingsMixedAreToldApart) {
    const JoinedWays joined = join({{1, 2, 3}, {11, 12}, {3, 4, 1}, {12, 13, 11}});
    EXPECT_TRUE(joined.all_close);
    EXPECT_THAT(joined.rings, ElementsAre(NodeIds{1, 2, 3, 4, 1}, NodeIds{11, 12, 13, 11}));
}

TEST(JoinedWays, RingsThatTouchComeApartInWhateverOrderTheirWaysCome) {
    // A clover: three rings of two ways each, all through node 9.
    const std::vector<NodeIds> clover{
        {9, 1, 2}, {2, 3, 9}, {9, 11, 12}, {12, 13, 9}, {9, 21, 22}, {22, 23, 9}};
    std::vector<std::size_t> order(clover.size());
    std::iota(order.begin(), order.end(), 0U);
    do {
        std::vector<NodeIds> ways;
        for (const std::size_t i : order)
            ways.push_back(clover[i]);
        const JoinedWays joined = join(ways);
        EXPECT_TRUE(joined.all_close);
        EXPECT_THAT(
            turned(joined.rings),
            ElementsAre(NodeIds{1, 2, 3, 9}, NodeIds{9, 11, 12, 13}, NodeIds{9, 21, 22, 23}));
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(JoinedWays, AnOpenPartLeavesTheOthersWhole) {
    // A way that leads away from a ring, before it and behind it in the order.
    for (const std::size_t at : {0U, 1U, 2U}) {
        std::vector<NodeIds> ways{{1, 2, 3}, {3, 4, 1}};
        ways.insert(ways.begin() + static_cast<std::ptrdiff_t>(at), NodeIds{3, 30});
        const JoinedWays joined = join(ways);
        EXPECT_FALSE(joined.all_close);
        EXPECT_THAT(turned(joined.rings), ElementsAre(NodeIds{1, 2, 3, 4}));
    }
    const JoinedWays open = join({{1, 2, 3}, {3, 4, 5}});
    EXPECT_FALSE(open.all_close);
    EXPECT_THAT(open.rings, IsEmpty());
    EXPECT_TRUE(join({}).all_close);
}

TEST(JoinedWays, ThousandsOfRingsThroughOneNodeAreNoHardship) {
    std::vector<NodeIds> ways;
    for (std::int64_t i = 1; i <= 20'000; ++i) {
        ways.push_back({0, 2 * i});
        ways.push_back({2 * i, 2 * i + 1, 0});
    }
    std::shuffle(ways.begin(), ways.end(), std::mt19937(7));
    const JoinedWays joined = join(ways);
    EXPECT_TRUE(joined.all_close);
    EXPECT_EQ(joined.rings.size(), 20'000U);
}

}  // namespace
}  // namespace reprise::towns

#include "world/tick.h"

#include <algorithm>
#include <bit>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "world/digest.h"

namespace reprise {

namespace {

using world::Digest128;
using world::SealedTick;
using world::TickDraft;

TickDraft busy_draft() {
    TickDraft draft;
    draft.tick.index = 42;
    draft.tick.road_friction = 0.7;
    draft.tick.vehicles = {test::vehicle_at(1, 10, 0, 0.3, 12), test::vehicle_at(4, 30, 2)};
    draft.tick.signals = {world::SignalColor::red, world::SignalColor::green};
    draft.tick.digests.mutate_physics(77);
    world::EventT event;
    event.kind = world::EventKind::collision;
    event.actor = 1;
    event.text = "bump";
    draft.tick.events.push_back(event);
    world::CommandT command;
    command.text = "ego";
    command.lanes = {3, 1, 2};
    draft.tick.commands.push_back(command);
    draft.traffic.cars = {test::car_at(1'000'000, 5, 5), test::car_at(1'000'007, 6, 6)};
    return draft;
}

std::vector<std::uint8_t> bytes_of(const SealedTick& sealed) {
    std::vector<std::uint8_t> bytes(sealed.tick_bytes().begin(), sealed.tick_bytes().end());
    bytes.insert(bytes.end(), sealed.traffic_bytes().begin(), sealed.traffic_bytes().end());
    return bytes;
}

Digest128 chain_of(const SealedTick& sealed) {
    return sealed.view().tick->digests()->chain();
}

std::uint64_t bits(double value) {
    return std::bit_cast<std::uint64_t>(value);
}

}  // namespace

TEST(Seal, GivesEqualBytesToEqualDrafts) {
    TickDraft one = busy_draft();
    TickDraft other = busy_draft();
    EXPECT_EQ(bytes_of(world::seal(one, {})), bytes_of(world::seal(other, {})));
}

TEST(Seal, GivesTheSameBytesWhenSealedAgain) {
    TickDraft draft = busy_draft();
    const auto first = bytes_of(world::seal(draft, {}));
    EXPECT_EQ(bytes_of(world::seal(draft, {})), first);
}

TEST(Seal, ChainsToHistory) {
    TickDraft draft = busy_draft();
    const Digest128 one_past(1, 2);
    const Digest128 other_past(1, 3);
    const SealedTick after_one = world::seal(draft, one_past);
    const SealedTick after_other = world::seal(draft, other_past);
    EXPECT_NE(chain_of(after_one), chain_of(after_other));
    EXPECT_EQ(after_one.view().tick->digests()->state(),
              after_other.view().tick->digests()->state());
    EXPECT_EQ(chain_of(after_one),
              world::chain(one_past, after_one.view().tick->digests()->state()));
}

TEST(Seal, CoversEveryStageAndTheIndex) {
    const auto state_after = [](auto&& change) {
        TickDraft draft = busy_draft();
        change(draft.tick);
        const SealedTick sealed = world::seal(draft, {});
        return sealed.view().tick->digests()->state();
    };
    const Digest128 plain = state_after([](world::TickT&) {});
    EXPECT_EQ(state_after([](world::TickT&) {}), plain);
    EXPECT_NE(state_after([](world::TickT& t) { t.index = 43; }), plain);
    EXPECT_NE(state_after([](world::TickT& t) { t.digests.mutate_scenario(1); }), plain);
    EXPECT_NE(state_after([](world::TickT& t) { t.digests.mutate_controls(1); }), plain);
    EXPECT_NE(state_after([](world::TickT& t) { t.digests.mutate_traffic(1); }), plain);
    EXPECT_NE(state_after([](world::TickT& t) { t.digests.mutate_pedestrians(1); }), plain);
    EXPECT_NE(state_after([](world::TickT& t) { t.digests.mutate_physics(1); }), plain);
    EXPECT_NE(state_after([](world::TickT& t) { t.digests.mutate_measurements(1); }), plain);
}

TEST(Seal, KeepsWhatTheDraftSaid) {
    TickDraft draft = busy_draft();
    const SealedTick sealed = world::seal(draft, {});
    const world::TickView view = sealed.view();
    EXPECT_EQ(view.index(), 42u);
    EXPECT_EQ(view.traffic->tick(), 42u);
    EXPECT_EQ(view.tick->road_friction(), 0.7);
    ASSERT_EQ(view.vehicles().size(), 2u);
    EXPECT_EQ(view.vehicles()[0], draft.tick.vehicles[0]);
    ASSERT_EQ(view.signals().size(), 2u);
    EXPECT_EQ(view.signals()[1], world::SignalColor::green);
    EXPECT_EQ(view.tick->events()->Get(0)->text()->str(), "bump");
    EXPECT_EQ(view.tick->commands()->Get(0)->lanes()->size(), 3u);
    EXPECT_EQ(view.cars()[1], draft.traffic.cars[1]);
}

TEST(Seal, KeepsTheSignOfZero) {
    TickDraft draft;
    draft.tick.road_friction = -0.0;
    draft.tick.vehicles = {test::vehicle_at(1, -0.0, 0.0)};
    world::EventT event;
    event.value = -0.0;
    draft.tick.events.push_back(event);
    const SealedTick sealed = world::seal(draft, {});
    EXPECT_EQ(bits(sealed.view().tick->road_friction()), bits(-0.0));
    EXPECT_EQ(bits(sealed.view().vehicles()[0].position().x()), bits(-0.0));
    EXPECT_EQ(bits(sealed.view().vehicles()[0].position().y()), bits(0.0));
    EXPECT_EQ(bits(sealed.view().tick->events()->Get(0)->value()), bits(-0.0));
}

/// A field that happens to be zero takes its place like any other.
TEST(Seal, GivesTheSameSizeWhateverTheValues) {
    TickDraft zero;
    TickDraft full;
    full.tick.index = 9;
    full.tick.road_friction = 1;
    EXPECT_EQ(world::seal(zero, {}).tick_bytes().size(), world::seal(full, {}).tick_bytes().size());
}

TEST(Seal, PassesTheVerifier) {
    TickDraft draft = busy_draft();
    const SealedTick sealed = world::seal(draft, {});
    flatbuffers::Verifier tick(sealed.tick_bytes().data(), sealed.tick_bytes().size());
    EXPECT_TRUE(world::VerifyTickBuffer(tick));
    flatbuffers::Verifier traffic(sealed.traffic_bytes().data(), sealed.traffic_bytes().size());
    EXPECT_TRUE(world::VerifyTrafficBuffer(traffic));
}

TEST(TickView, IsEmptyWhereTheDraftWas) {
    TickDraft draft;
    const SealedTick sealed = world::seal(draft, {});
    const world::TickView view = sealed.view();
    EXPECT_TRUE(view.vehicles().empty());
    EXPECT_TRUE(view.wheels().empty());
    EXPECT_TRUE(view.controls().empty());
    EXPECT_TRUE(view.measurements().empty());
    EXPECT_TRUE(view.signals().empty());
    EXPECT_TRUE(view.cars().empty());
    EXPECT_TRUE(view.walkers().empty());
}

TEST(Find, FindsEveryIdInASortedViewAndNoOther) {
    const std::vector<std::uint32_t> ids{1, 2, 5, 9, 1'000'000, 1'000'003};
    std::vector<world::CarState> cars;
    for (const std::uint32_t id : ids)
        cars.push_back(test::car_at(id, id, 0));
    const SealedTick sealed = test::tick_with({}, cars);
    for (const std::uint32_t id : ids) {
        const world::CarState* car = world::find(sealed.view().cars(), id);
        ASSERT_NE(car, nullptr);
        EXPECT_EQ(car->id(), id);
    }
    for (const std::uint32_t id : {0u, 3u, 999'999u, 1'000'001u, world::none})
        EXPECT_EQ(world::find(sealed.view().cars(), id), nullptr);
    EXPECT_EQ(world::find(sealed.view().vehicles(), 1), nullptr);
}

TEST(Seconds, AreComputedFromTheIndex) {
    EXPECT_DOUBLE_EQ(world::seconds(20, 50'000'000), 1.0);
    EXPECT_DOUBLE_EQ(world::seconds(72'000, 50'000'000), 3600.0);
}

}  // namespace reprise

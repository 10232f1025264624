#include "replay/noun_check.h"

#include <cstring>
#include <random>

#include <gmock/gmock.h>

#include "replay/compare/divergence.h"
#include "replay/trace_format.h"
#include "tests/replay/synthetic_run.h"
#include "tests/support/worlds.h"

namespace reprise::test {

namespace {

using replay::mcap::View;
using testing::HasSubstr;

/// 8-aligned bytes that a forger may change.
class Forgery {
  public:
    explicit Forgery(View bytes) : words_(bytes.size() / 8 + 1), size_(bytes.size()) {
        std::memcpy(words_.data(), bytes.data(), size_);
    }

    View bytes() const { return {reinterpret_cast<const std::uint8_t*>(words_.data()), size_}; }

    /// Overwrites one, two or four bytes with a telling or a random value.
    void change(std::mt19937_64& random) {
        constexpr std::uint32_t telling[] = {0, 1, 2, 4, 8, 0x7fff, 0xffff, 0x7fffffff, 0xffffffff};
        const std::uint32_t value =
            random() % 2 == 0 ? telling[random() % 9] : static_cast<std::uint32_t>(random());
        const std::size_t at = random() % size_;
        const std::size_t width = std::min(std::size_t{1} << random() % 3, size_ - at);
        std::memcpy(reinterpret_cast<std::uint8_t*>(words_.data()) + at, &value, width);
    }

  private:
    std::vector<std::uint64_t> words_;
    std::size_t size_;
};

/// A tick with some of everything.
world::SealedTick rich_tick() {
    const auto fill = [](world::TickDraft& draft) {
        world::CommandT command;
        command.text = "ego";
        command.lanes = {1, 2};
        draft.tick.commands = {command, command};
        draft.traffic.walkers.emplace_back();
    };
    return std::move(drive({.ticks = 1, .cars = 3, .change = fill}).front());
}

/// What fault_of_tick says about a tick changed so.
std::string fault(const Change& change) {
    const auto tick = drive({.ticks = 1, .change = change});
    const auto of_tick = replay::fault_of_tick(tick.front().tick_bytes(), 1);
    const auto of_traffic = replay::fault_of_traffic(tick.front().traffic_bytes(), 1);
    return of_tick.value_or("") + of_traffic.value_or("");
}

TEST(NounCheck, AcceptsSoundTicks) {
    EXPECT_EQ(fault({}), "");
}

TEST(NounCheck, RefusesWhatReadersWouldStumbleOver) {
    using Draft = world::TickDraft;
    EXPECT_THAT(fault([](Draft& d) { std::swap(d.traffic.cars[0], d.traffic.cars[1]); }),
                HasSubstr("out of order"));
    EXPECT_THAT(fault([](Draft& d) { d.tick.vehicles.push_back(d.tick.vehicles[0]); }),
                HasSubstr("out of order"));
    EXPECT_THAT(fault([](Draft& d) { d.tick.signals[0] = world::SignalColor{99}; }),
                HasSubstr("unknown kind"));
    EXPECT_THAT(fault([](Draft& d) { d.tick.events[0].kind = world::EventKind{99}; }),
                HasSubstr("unknown kind"));
    EXPECT_THAT(fault([](Draft& d) { d.tick.vehicles[0].mutate_model(999); }),
                HasSubstr("unknown model 999 of vehicle 1"));
    EXPECT_THAT(fault([](Draft& d) { d.traffic.cars[0].mutate_model(999); }),
                HasSubstr("unknown model 999 of car 1000000"));
    EXPECT_THAT(fault([](Draft& d) { d.tick.index = 5; }), HasSubstr("says that it is tick 5"));
}

TEST(NounCheck, RefusesATownWhoseLanesLeadNowhere) {
    const auto town_fault = [](const std::function<void(world::TownT&)>& change) {
        world::TownT town = straight_road_with_signal();
        change(town);
        const Forgery packed(replay::format::pack(town));
        return replay::fault_of_town(packed.bytes()).value_or("");
    };
    EXPECT_EQ(town_fault([](world::TownT&) {}), "");
    EXPECT_THAT(town_fault([](auto& town) { town.lanes[1].left = 77; }), HasSubstr("lane east_1"));
    EXPECT_THAT(town_fault([](auto& town) { town.lanes[1].links[0].mutate_to(77); }),
                HasSubstr("lane east_1"));
    EXPECT_THAT(town_fault([](auto& town) { town.lanes[2].centre.resize(1); }), HasSubstr("lane"));
    EXPECT_THAT(town_fault([](auto& town) { town.signals[0].lane = 77; }), HasSubstr("signal"));
}

world::TownT furnished_town() {
    world::TownT town = straight_road_with_signal();
    const std::vector<world::Vec3> square{{0, 20, 0}, {9, 20, 0}, {9, 29, 0}, {0, 29, 0}};
    town.buildings.emplace_back(world::Vec3(50, 20, 0), 0, 10, 10, 6, 1U, 2U);
    town.trees.emplace_back(world::Vec3(30, 20, 0), 8, 2, 1U, world::PlantKind::lime);
    town.props.emplace_back(
        world::Vec3(9, 9, 0), 0, 4, 2, 1, 1U, 0, world::PropKind::parked_vehicle, 0);
    town.spawn_points.emplace_back(world::Vec3(5, 0, 0), 0, 5, 0U, false, 0, 0);
    town.plots.emplace_back().outline = square;
    town.drawn_buildings.emplace_back().outline = square;
    town.heads.emplace_back().signals = {0};
    return town;
}

TEST(NounCheck, RefusesATownWhoseSceneryCannotBe) {
    const auto fault = [](const std::function<void(world::TownT&)>& change) {
        world::TownT town = furnished_town();
        change(town);
        const Forgery packed(replay::format::pack(town));
        return replay::fault_of_town(packed.bytes()).value_or("");
    };
    EXPECT_EQ(fault([](world::TownT&) {}), "");
    EXPECT_THAT(fault([](auto& t) { t.buildings[0].mutate_model(41); }), HasSubstr("building"));
    EXPECT_THAT(fault([](auto& t) { t.drawn_buildings[0].model = 41; }), HasSubstr("building"));
    EXPECT_THAT(fault([](auto& t) { t.drawn_buildings[0].outline.resize(2); }),
                HasSubstr("outline"));
    EXPECT_THAT(fault([](auto& t) { t.plots[0].outline.clear(); }), HasSubstr("outline"));
    EXPECT_THAT(fault([](auto& t) { t.trees[0].mutate_kind(static_cast<world::PlantKind>(99)); }),
                HasSubstr("plant"));
    EXPECT_THAT(fault([](auto& t) { t.props[0].mutate_value(99); }), HasSubstr("furniture"));
    EXPECT_THAT(fault([](auto& t) { t.props[0].mutate_kind(static_cast<world::PropKind>(99)); }),
                HasSubstr("furniture"));
    EXPECT_THAT(fault([](auto& t) { t.spawn_points[0].mutate_lane(77); }), HasSubstr("spawn"));
    EXPECT_THAT(fault([](auto& t) { t.heads[0].signals = {77}; }), HasSubstr("head"));
    EXPECT_THAT(fault([](auto& t) { t.heads[0].signals.clear(); }), HasSubstr("head"));
}

TEST(NounCheck, RefusesStructsThatDoNotLieAligned) {
    const world::SealedTick sound = rich_tick();
    Forgery forged(sound.traffic_bytes());
    auto* bytes = const_cast<std::uint8_t*>(forged.bytes().data());
    // The vector of cars begins four bytes later, where its first car was.
    const auto* traffic = world::GetTraffic(bytes);
    const auto field = reinterpret_cast<const flatbuffers::Table*>(traffic)->GetAddressOf(
                           world::Traffic::VT_CARS) -
                       bytes;
    const auto vector = reinterpret_cast<const std::uint8_t*>(traffic->cars()) - bytes;
    const auto offset = static_cast<std::uint32_t>(vector - field) + 4;
    const std::uint32_t one = 1;
    std::memcpy(bytes + field, &offset, sizeof(offset));
    std::memcpy(bytes + vector + 4, &one, sizeof(one));
    EXPECT_THAT(replay::fault_of_traffic(forged.bytes(), 1).value_or(""), HasSubstr("missing"));
}

TEST(NounCheck, LetsNoForgedTickThroughThatCannotBeRead) {
    const world::SealedTick sound = rich_tick();
    std::mt19937_64 random(1);
    int accepted = 0;
    for (int i = 0; i < 10'000; ++i) {
        Forgery tick(sound.tick_bytes());
        Forgery traffic(sound.traffic_bytes());
        (i % 2 == 0 ? tick : traffic).change(random);
        if (replay::fault_of_tick(tick.bytes(), 1) || replay::fault_of_traffic(traffic.bytes(), 1))
            continue;
        ++accepted;
        // Reads every field of both; sanitizers watch.
        const replay::RecordedTick forged{
            {world::GetTick(tick.bytes().data()), world::GetTraffic(traffic.bytes().data())},
            tick.bytes(),
            traffic.bytes()};
        EXPECT_EQ(compare(as_recorded(sound), forged).has_value(),
                  bytes_of(forged) != bytes_of(sound));
    }
    EXPECT_GT(accepted, 500);
}

TEST(NounCheck, LetsNoForgedTownOrEpisodeThroughThatCannotBeRead) {
    const replay::mcap::Bytes town = replay::format::pack(furnished_town());
    const replay::mcap::Bytes episode = replay::format::pack(recording().episode);
    std::mt19937_64 random(2);
    int accepted = 0;
    for (int i = 0; i < 5'000; ++i) {
        Forgery forged_town(town);
        forged_town.change(random);
        if (!replay::fault_of_town(forged_town.bytes())) {
            world::TownT unpacked;
            world::GetTown(forged_town.bytes().data())->UnPackTo(&unpacked);
            EXPECT_EQ(unpacked.lanes.size(), 4u);
            ++accepted;
        }
        Forgery forged_episode(episode);
        forged_episode.change(random);
        if (!replay::fault_of_episode(forged_episode.bytes())) {
            world::EpisodeT unpacked;
            world::GetEpisode(forged_episode.bytes().data())->UnPackTo(&unpacked);
            EXPECT_NE(unpacked.step_ns, 0u);
            ++accepted;
        }
    }
    EXPECT_GT(accepted, 100);
}

}  // namespace

}  // namespace reprise::test

// A trace that an older program wrote is still read, to the last field.
#include <algorithm>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"
#include "world/digest.h"

namespace reprise::test {
namespace {

using replay::TraceReader;
using testing::Contains;
using testing::HasSubstr;

std::filesystem::path trace_file(const std::string& name) {
    return std::filesystem::path(REPRISE_TRACES) / name;
}

std::string text_of(const std::string& name) {
    const auto bytes = read_file(trace_file(name));
    return {bytes.begin(), bytes.end()};
}

/// Texts of all events of a kind.
std::vector<std::string> said(TraceReader& trace, world::EventKind kind) {
    std::vector<std::string> texts;
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
        for (const world::Event* event : *trace.tick(index).view.tick->events())
            if (event->kind() == kind)
                texts.push_back(event->text() == nullptr ? "" : event->text()->str());
    return texts;
}

/// Position and speed of an actor, whoever moves it.
struct Seen {
    double x = 0;
    double y = 0;
    double speed = 0;
};

Seen seen(const world::TickView& tick, std::uint32_t id) {
    if (const world::VehicleState* vehicle = world::find(tick.vehicles(), id))
        return {vehicle->position().x(),
                vehicle->position().y(),
                world::find(tick.measurements(), id)->speed()};
    if (const world::CarState* car = world::find(tick.cars(), id))
        return {car->position().x(), car->position().y(), static_cast<double>(car->speed())};
    const world::WalkerState* walker = world::find(tick.walkers(), id);
    return {walker->position().x(), walker->position().y(), static_cast<double>(walker->speed())};
}

class OldTrace : public testing::Test {
  protected:
    TraceReader trace_{trace_file("v1_small.mcap")};
};

TEST_F(OldTrace, TellsWhatItStartedFrom) {
    const world::Recording& recording = trace_.recording();
    EXPECT_EQ(recording.episode.name, "v1_small");
    EXPECT_EQ(recording.episode.scenario, text_of("v1_small.lua"));
    EXPECT_EQ(recording.network, text_of("small.net.xml"));
    EXPECT_EQ(recording.episode.town_digest, world::digest128(recording.network));
    EXPECT_EQ(recording.episode.seed, 11U);
    EXPECT_EQ(recording.episode.step_ns, 50'000'000U);
    ASSERT_EQ(recording.episode.parameters.size(), 1U);
    EXPECT_EQ(recording.episode.parameters[0].key, "throttle");
    EXPECT_EQ(recording.episode.parameters[0].value, "0.8");
    EXPECT_EQ(recording.episode.fingerprint.front().value, "0.1.0");
    const auto& lanes = recording.town.lanes;
    EXPECT_TRUE(std::any_of(
        lanes.begin(), lanes.end(), [](const auto& lane) { return lane.name == "am_1"; }));
    EXPECT_EQ(trace_.chain(0), replay::chain_seed(recording));
}

TEST_F(OldTrace, HasAnUnbrokenChain) {
    EXPECT_EQ(trace_.damage(), std::nullopt);
    ASSERT_EQ(trace_.ticks(), 66U);
    world::Digest128 chain = trace_.chain(0);
    for (std::uint64_t index = 1; index <= trace_.ticks(); ++index) {
        chain = world::chain(chain, trace_.tick(index).view.tick->digests()->state());
        ASSERT_EQ(chain, trace_.chain(index)) << index;
    }
    // As the program that recorded it printed it.
    EXPECT_EQ(world::to_hex(chain), "849d92d3650c90733f72210ce6038d58");
    EXPECT_EQ(trace_.outcome().verdict, "failed");
    EXPECT_EQ(trace_.outcome().reason, "time limit");
}

/// Two routes: what the scenario printed about the actors while it ran, and the recorded tick.
TEST_F(OldTrace, ShowsTheActorsWhereTheirScenarioSawThem) {
    int actors = 0;
    for (const std::string& line : said(trace_, world::EventKind::printed)) {
        std::istringstream words(line);
        std::uint64_t tick = 0;
        std::uint32_t id = 0;
        Seen expected;
        if (!(words >> tick >> id >> expected.x >> expected.y >> expected.speed))
            continue;
        ++actors;
        const Seen found = seen(trace_.tick(tick).view, id);
        EXPECT_EQ(found.x, expected.x) << id;
        EXPECT_EQ(found.y, expected.y) << id;
        EXPECT_EQ(found.speed, expected.speed) << id;
    }
    EXPECT_EQ(actors, 4);
}

TEST_F(OldTrace, TellsWhatHappened) {
    EXPECT_THAT(said(trace_, world::EventKind::printed), Contains("rain"));
    EXPECT_THAT(said(trace_, world::EventKind::spawned), Contains("child"));
    EXPECT_THAT(said(trace_, world::EventKind::check_failed), Contains(HasSubstr("hit the van")));
    EXPECT_EQ(said(trace_, world::EventKind::collision).size(), 10U);  // as that run counted
    EXPECT_EQ(trace_.tick(1).view.tick->weather()->rain(), 0);
    bool walks = false;
    for (const std::uint64_t index : {1U, 2U})  // the child must be there first
        for (const world::Command* command : *trace_.tick(index).view.tick->commands())
            walks = walks || command->kind() == world::CommandKind::walk;
    EXPECT_TRUE(walks);
    const std::size_t signals = trace_.recording().town.signals.size();
    const world::TickView last = trace_.tick(trace_.ticks()).view;
    EXPECT_EQ(last.tick->weather()->rain(), 50);  // hard_rain_sunset, [mm/h]
    EXPECT_EQ(last.tick->road_friction(), 0.68);
    EXPECT_EQ(last.wheels().size(), 4U);
    EXPECT_EQ(last.signals().size(), signals);
    EXPECT_EQ(last.controls().front().throttle(), 0.8);
}

}  // namespace
}  // namespace reprise::test

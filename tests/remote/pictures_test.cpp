#include <array>
#include <cmath>
#include <deque>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "remote/frame_channel.h"
#include "remote/messages.h"
#include "remote/shared_memory.h"
#include "tests/support/worlds.h"
#include "world/check.h"

namespace reprise::remote {
namespace {

world::Rig two_sensors() {
    world::Rig rig;
    rig.since = 4;
    for (const unsigned every : {1U, 3U}) {
        world::SensorSpec sensor;
        sensor.name = "every" + std::to_string(every);
        sensor.width = 5;
        sensor.height = 3;
        rig.sensors.push_back(sensor);
        rig.every.push_back(every);
    }
    return rig;
}

bool overlap(const PlacedPicture& one, const PlacedPicture& other) {
    return one.offset < other.offset + other.size && other.offset < one.offset + one.size;
}

/// Plays a run with a driver that is as late as it may be, and keeps its last tick's pictures.
TEST(PictureRing, WritesNowhereWhereADriverMayStillLook) {
    for (const unsigned latency : {0U, 1U, 5U}) {
        const PictureRing ring(two_sensors(), latency);
        std::deque<std::vector<PlacedPicture>> looked_at;  // asked for; the front was answered last
        for (std::uint64_t tick = 4; tick < 40; ++tick) {
            const std::vector<PlacedPicture> written = ring.of(tick);
            for (const PlacedPicture& now : written) {
                EXPECT_LE(now.offset + now.size, ring.bytes());
                EXPECT_EQ(now.offset % 64, 0U);
                for (const auto& before : looked_at)
                    for (const PlacedPicture& picture : before)
                        EXPECT_FALSE(overlap(now, picture)) << tick << ", latency " << latency;
            }
            looked_at.push_back(written);
            if (looked_at.size() > std::size_t{1} + latency)
                looked_at.pop_front();
        }
    }
}

TEST(SharedMemory, IsSeenByWhoItIsHandedOverTo) {
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    FrameChannel near(ends[0], 1 << 20);
    FrameChannel far(ends[1], 1 << 20);
    SharedMemory memory(1000);
    Packed goodbye;
    goodbye.Finish(CreateGoodbye(goodbye));
    near.send(Kind::goodbye, bytes_of(goodbye), {}, memory.for_looking().number());
    near.send(Kind::goodbye, bytes_of(goodbye));
    Frame frame = far.receive();
    EXPECT_NE(fcntl(frame.descriptor.number(), F_GETFD) & FD_CLOEXEC, 0);
    EXPECT_LT(far.receive().descriptor.number(), 0) << "it comes once";
    const SharedMemory seen(std::move(frame.descriptor), 1000, SharedMemory::Use::look);
    memory.writable()[999] = 42;
    EXPECT_EQ(seen.bytes()[999], 42);
}

TEST(SharedMemory, CannotBePulledAway) {
    const SharedMemory memory(4096);
    EXPECT_NE(ftruncate(memory.descriptor(), 0), 0);
    EXPECT_THROW(SharedMemory(memory.for_looking(), 4097, SharedMemory::Use::look), world::Error);
    Descriptor unsealed(memfd_create("test", MFD_CLOEXEC));
    ASSERT_EQ(ftruncate(unsealed.number(), 4096), 0);
    EXPECT_THROW(SharedMemory(std::move(unsealed), 4096, SharedMemory::Use::look), world::Error);
    EXPECT_THROW(SharedMemory(Descriptor(), 1, SharedMemory::Use::look), world::Error);
}

TEST(FrameChannel, KnowsWhetherItCarriesDescriptors) {
    const FrameChannel local(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0), 1);
    const FrameChannel tcp(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), 1);
    EXPECT_TRUE(local.carries_descriptors());
    EXPECT_FALSE(tcp.carries_descriptors());
}

TEST(Observation, CarriesThePixelsWhereTheyCannotBeShared) {
    const std::array<std::uint8_t, 6> memory{0, 1, 2, 3, 4, 5};
    const std::array<PlacedPicture, 1> pictures{PlacedPicture{2, 9, 3, 2}};
    for (const bool shared : {true, false}) {
        const Packed message = pack_observation({}, {}, pictures, shared ? nullptr : memory.data());
        const auto* seen = flatbuffers::GetRoot<Observation>(message.GetBufferPointer());
        const Picture& picture = *seen->pictures()->Get(0);
        EXPECT_EQ(picture.sensor(), 2);
        EXPECT_EQ(picture.tick(), 9U);
        EXPECT_EQ(picture.offset(), 3U);
        ASSERT_EQ(picture.data() == nullptr, shared);
        if (shared)
            continue;
        EXPECT_THAT(std::vector<std::uint8_t>(picture.data()->begin(), picture.data()->end()),
                    testing::ElementsAre(3, 4));
    }
}

TEST(OwnTick, HoldsNothingOfOthers) {
    world::TickDraft draft;
    draft.tick.index = 12;
    draft.tick.weather.mutate_rain(5);
    draft.tick.road_friction = 0.7;
    draft.tick.signals = {world::SignalColor::red};
    draft.tick.events.emplace_back();
    draft.tick.commands.emplace_back();
    for (const std::uint32_t id : {3U, 7U, 9U}) {
        world::VehicleState state{};
        state.mutate_id(id);
        draft.tick.vehicles.push_back(state);
        world::Measurement measured{};
        measured.mutate_actor(id);
        measured.mutate_speed(id);
        measured.mutate_gap_ahead(5);
        draft.tick.measurements.push_back(measured);
        draft.tick.controls.push_back(world::Control(0.1, 0, 0, id, 0, false, false));
        draft.tick.looks.push_back(world::Look(id, 1));
        for (std::uint8_t wheel = 0; wheel < 4; ++wheel) {
            world::WheelState turning{};
            turning.mutate_vehicle(id);
            draft.tick.wheels.push_back(turning);
        }
    }
    const world::SealedTick sealed = world::seal(draft, {});
    const auto bytes = own_tick(sealed.view(), 7);
    const world::TickView own{world::GetTick(bytes.data()), sealed.view().traffic};
    EXPECT_EQ(own.index(), 12U);
    ASSERT_EQ(own.vehicles().size(), 1U);
    EXPECT_EQ(own.vehicles()[0].id(), 7U);
    ASSERT_EQ(own.measurements().size(), 1U);
    EXPECT_EQ(own.measurements()[0].speed(), 7);
    EXPECT_TRUE(std::isnan(own.measurements()[0].gap_ahead())) << "it is seen, not felt";
    EXPECT_EQ(own.controls().size(), 1U);
    EXPECT_EQ(own.wheels().size(), 4U);
    EXPECT_TRUE(own.signals().empty());
    EXPECT_TRUE(own.vehicle_looks().empty());
    EXPECT_EQ(own.tick->events()->size(), 0U);
    EXPECT_EQ(own.tick->commands()->size(), 0U);
    EXPECT_EQ(own.tick->weather()->rain(), 0);
    EXPECT_EQ(own.tick->road_friction(), 0);
    EXPECT_EQ(own.tick->digests()->chain().low(), 0U);
}

}  // namespace
}  // namespace reprise::remote

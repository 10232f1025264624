#include <array>
#include <cmath>
#include <deque>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "process/companion.h"
#include "remote/client.h"
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

/// What measures no pixels and no points says it in messages, but memory of no bytes is none.
TEST(PictureRing, OfReadingsOnlyHasMemoryToHandOver) {
    world::Rig rig;
    world::SensorSpec sensor;
    sensor.name = "motion";
    sensor.kind = world::SensorKind::imu;
    rig.sensors = {sensor};
    rig.every = {1};
    const PictureRing ring(rig, 0);
    ASSERT_GT(ring.bytes(), 0U);
    EXPECT_EQ(SharedMemory(ring.bytes()).bytes().size(), ring.bytes());
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

/// Two ends of a connection over TCP on this machine, which carries no descriptors.
std::array<int, 2> tcp_pair() {
    const Descriptor listener(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    auto* place = reinterpret_cast<sockaddr*>(&address);
    const int far = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(bind(listener.number(), place, size), 0);
    EXPECT_EQ(listen(listener.number(), 1), 0);
    EXPECT_EQ(getsockname(listener.number(), place, &size), 0);
    EXPECT_EQ(connect(far, place, size), 0);
    return {accept4(listener.number(), nullptr, nullptr, SOCK_CLOEXEC), far};
}

/// A spawn with one camera of 2 x 1 px, that looks in each second tick.
world::CommandT with_camera() {
    world::CommandT spawn;
    spawn.kind = world::CommandKind::spawn;
    auto& sensor = *spawn.rig.emplace_back(std::make_unique<world::SensorT>());
    sensor.name = "front";
    sensor.width = 2;
    sensor.height = 1;
    sensor.fov = 1;
    sensor.every = 2;
    return spawn;
}

/// The run's part for a driver over TCP that carries one camera of 2 x 1 px: one tick with a frame,
/// one without. Returns what it says to the first, of which the throttle is what it saw.
double throttle_for_picture(FrameChannel& channel) {
    const world::CommandT spawn = with_camera();
    world::Recording recording;
    recording.town = test::straight_road(100, 1);
    channel.send(Kind::hello, bytes_of(pack_hello({1, "ego", &spawn, 0}, recording)));
    EXPECT_EQ(channel.receive().kind, Kind::ready);
    world::TickDraft draft;
    draft.tick.index = 5;
    const world::SealedTick tick = world::seal(draft, {});
    const std::array<std::uint8_t, 6> memory{10, 20, 30, 40, 50, 60};
    const std::array<PlacedPicture, 1> pictures{PlacedPicture{0, 5, 0, 6}};
    channel.send(Kind::observation,
                 bytes_of(pack_observation(tick.tick_bytes(), {}, pictures, memory.data())));
    const Frame answer = channel.receive();
    EXPECT_EQ(answer.kind, Kind::control);
    channel.send(Kind::observation, bytes_of(pack_observation(tick.tick_bytes(), {}, {}, nullptr)));
    const Frame blind = channel.receive();
    EXPECT_EQ(blind.kind, Kind::control);
    EXPECT_EQ(blind.as<Control>().throttle(), 0);
    Packed goodbye;
    goodbye.Finish(CreateGoodbye(goodbye));
    channel.send(Kind::goodbye, bytes_of(goodbye));
    return answer.as<Control>().throttle();
}

TEST(Pictures, ComeInMessagesToADriverInCppThatSharesNoMemory) {
    const auto [ours, theirs] = tcp_pair();
    FrameChannel channel(ours, 64 << 10);
    std::thread driver([address = "fd:" + std::to_string(theirs)] {
        Client run(address);
        while (run.next()) {
            const auto seen = run.picture("front");
            EXPECT_THROW(run.picture("back"), world::Error);
            run.say({.throttle = seen ? seen->pixels[4] / 100.0 : 0});
        }
    });
    EXPECT_EQ(throttle_for_picture(channel), 0.5);
    driver.join();
}

/// A run that says where they are is believed no farther than the memory goes.
TEST(Pictures, ThatWouldLieBeyondTheSharedMemoryAreRefused) {
    constexpr std::size_t bytes = 64;
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
    FrameChannel run(ends[0], 64 << 10);
    const SharedMemory memory(bytes);
    const world::CommandT spawn = with_camera();
    world::Recording recording;
    recording.town = test::straight_road(100, 1);
    run.send(Kind::hello,
             bytes_of(pack_hello({1, "ego", &spawn, nullptr, bytes}, recording)),
             {},
             memory.for_looking().number());
    Client driver(FrameChannel(ends[1], 1 << 20), 0);
    world::TickDraft draft;
    draft.tick.index = 5;
    const world::SealedTick tick = world::seal(draft, {});
    const std::size_t last = bytes - 6;  // of a picture of 2 x 1 px
    for (const std::size_t offset : {std::size_t{0}, last, last + 1, bytes + 1, ~std::size_t{2}}) {
        const std::array<PlacedPicture, 1> pictures{PlacedPicture{0, 5, offset, 6}};
        run.send(Kind::observation,
                 bytes_of(pack_observation(tick.tick_bytes(), {}, pictures, nullptr)));
        ASSERT_TRUE(driver.next());
        if (offset <= last)
            EXPECT_EQ(driver.picture("front")->pixels.size(), 6U);
        else
            EXPECT_THROW(driver.picture("front"), world::Error) << offset;
    }
}

TEST(Pictures, ComeInMessagesToADriverInPythonThatSharesNoMemory) {
    const auto [ours, theirs] = tcp_pair();
    FrameChannel channel(ours, 64 << 10);
    const process::Companion driver(
        "PYTHONPATH=" REPRISE_SOURCE
        "/python exec /usr/bin/python3 -B -c 'import reprise; "
        "reprise.drive(lambda seen: reprise.Control(throttle=seen.image(\"front\")[0, 1, 1] / "
        "100 if seen.images else 0))'",
        theirs,
        "REPRISE_DRIVER=fd:%d");
    close(theirs);
    EXPECT_EQ(throttle_for_picture(channel), 0.5);
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

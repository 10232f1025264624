#include "remote/seat.h"

#include <array>
#include <atomic>
#include <fstream>
#include <sys/socket.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "remote/client.h"
#include "remote/connection.h"
#include "remote/frame_channel.h"
#include "remote/messages.h"
#include "remote/schema.h"
#include "remote/simulation.h"
#include "tests/support/places.h"
#include "world/check.h"

namespace reprise::remote {
namespace {

using testing::HasSubstr;

world::Recording recording() {
    world::Recording recording;
    recording.town = test::t_junction(0);
    recording.episode.name = "test";
    recording.episode.scenario = "a secret plan";
    recording.episode.step_ns = 50'000'000;
    return recording;
}

world::SealedTick tick(std::uint64_t index) {
    world::TickDraft draft;
    draft.tick.index = index;
    return world::seal(draft, {});
}

struct Drive {
    std::vector<world::Control> controls;
    std::string lost;
};

/// Five ticks with a driver of this habit.
Drive drive(const std::string& command, std::optional<double> patience = {}) {
    Seat seat({"ego", command}, {patience});
    Drive result;
    if (const auto lost = seat.take(7, recording())) {
        result.lost = lost->reason;
        return result;
    }
    for (std::uint64_t index = 1; index <= 5; ++index) {
        if (const auto lost = seat.show(tick(index))) {
            result.lost = lost->reason;
            break;
        }
        const auto answer = seat.answer();
        if (const auto* lost = std::get_if<Lost>(&answer)) {
            result.lost = lost->reason;
            break;
        }
        result.controls.push_back(std::get<world::Control>(answer));
    }
    return result;
}

Drive drive_oddly(const std::string& habit, std::optional<double> patience = {}) {
    return drive(ODD_DRIVER " " + habit, patience);
}

TEST(Seat, TheDriversControlsArriveAsItSaidThem) {
    const Drive done = drive_oddly("steady");
    EXPECT_EQ(done.lost, "");
    ASSERT_EQ(done.controls.size(), 5U);
    EXPECT_EQ(done.controls.back().throttle(), 0.25);
    EXPECT_EQ(done.controls.back().steer(), 0.125);
    EXPECT_EQ(done.controls.back().lamps(), 8);
    EXPECT_EQ(done.controls.back().actor(), 7U);
}

struct Fault {
    const char* habit;
    const char* told;
    std::size_t ticks_before;
};

class FaultyDriver : public testing::TestWithParam<Fault> {};

TEST_P(FaultyDriver, IsLostWithItsReason) {
    const Drive done = drive_oddly(GetParam().habit);
    EXPECT_THAT(done.lost, HasSubstr(GetParam().told));
    EXPECT_EQ(done.controls.size(), GetParam().ticks_before);
}

INSTANTIATE_TEST_SUITE_P(
    EachHabit,
    FaultyDriver,
    testing::Values(Fault{"dies", "the driver of 'ego' ended with exit code 3", 2},
                    Fault{"crashes", "was ended by signal 6", 2},
                    Fault{"leaves_a_child", "ended with exit code 3", 2},
                    Fault{"nan", "said throttle = nan where [0, 1] is possible", 2},
                    Fault{"too_much", "said steer = -1.5 where [-1, 1] is possible", 2},
                    Fault{"twice", "answered tick 3 when tick 4 was to be answered", 3},
                    Fault{"ahead", "answered tick 9 when tick 3 was to be answered", 2},
                    Fault{"garbage", "bytes, where 65536 is the most", 2},
                    Fault{"huge", "4294967295 bytes, where 65536 is the most", 2},
                    Fault{"cut", "ended with exit code 0", 2},
                    Fault{"never_ready", "ended with exit code 5", 0},
                    Fault{"other_version", "speaks version 2 of the wire, this is 1", 0}),
    [](const auto& info) { return std::string(info.param.habit); });

TEST(Seat, ASilentDriverIsWaitedForAsLongAsToldAndThenLost) {
    const Drive done = drive_oddly("silent", 0.2);
    EXPECT_THAT(done.lost, HasSubstr("said nothing in time"));
    EXPECT_EQ(done.controls.size(), 2U);
}

TEST(Seat, ACommandThatIsNoneIsLostAtOnce) {
    EXPECT_THAT(drive("/no/such/program").lost, HasSubstr("ended with exit code 127"));
}

TEST(Seat, ADriverThatAlreadyRunsComesToTheSocket) {
    const std::string path = testing::TempDir() + "seat_test_" + std::to_string(getpid());
    Seat seat({"ego", "", path}, {10.0});
    std::string name;
    std::uint64_t last = 0;
    std::string script;
    std::thread driver([&] {
        Client run(path);
        name = run.name();
        script = run.episode().scenario;
        while (const auto seen = run.next()) {
            last = seen->index();
            run.say({.brake = 1});
        }
    });
    const auto taken = seat.take(3, recording());
    EXPECT_FALSE(taken) << taken->reason;
    EXPECT_FALSE(seat.show(tick(11)));
    const auto answer = seat.answer();
    seat.leave("done");
    driver.join();
    ASSERT_TRUE(std::holds_alternative<world::Control>(answer));
    EXPECT_EQ(std::get<world::Control>(answer).brake(), 1);
    EXPECT_EQ(name, "ego");
    EXPECT_EQ(last, 11U);
    EXPECT_EQ(script, "") << "a driver sees the road, not the script";
    EXPECT_FALSE(std::filesystem::exists(path));
}

/// How a driver is lost whose vehicle carries a camera, with this in place of what renders.
Lost lost_by_renderer(const std::string& program) {
    Seat seat({"ego", ODD_DRIVER " steady"}, {10.0});
    world::CommandT spawn;
    spawn.kind = world::CommandKind::spawn;
    spawn.actor = 7;
    spawn.text = "ego";
    spawn.rig.push_back(std::make_unique<world::SensorT>());
    world::SensorT& camera = *spawn.rig.back();
    camera.name = "front";
    camera.width = camera.height = 8;
    camera.fov = 1;
    camera.every = 1;
    auto lost = seat.take(7, recording(), {&spawn, 1, 1, program});
    if (!lost)
        lost = seat.show(tick(1));
    if (!lost)
        lost = seat.show_due();
    if (lost)
        return std::move(*lost);
    auto answer = seat.answer();
    return std::get<Lost>(std::move(answer));
}

TEST(Seat, ARendererThatEndsIsOurFaultUnlessItHasSaidWhatItLacks) {
    const Lost crashed = lost_by_renderer("exit 70");
    EXPECT_THAT(crashed.reason, HasSubstr("renders for 'ego' ended with exit code 70"));
    EXPECT_TRUE(crashed.ours);
    EXPECT_TRUE(lost_by_renderer("kill -9 $$").ours);
    const Lost starved = lost_by_renderer("exit 2");  // behind "reprise: out of memory"
    EXPECT_THAT(starved.reason, HasSubstr("renders for 'ego' could not go on, and has said why"));
    EXPECT_FALSE(starved.ours);
}

TEST(Seat, WhatADriverSaysAtItsEndIsShortened) {
    const Drive done = drive_oddly("chatters");
    EXPECT_THAT(done.lost, HasSubstr("left: I am\nxxx"));
    EXPECT_LT(done.lost.size(), 400U);
}

std::vector<std::uint8_t> said(flatbuffers::FlatBufferBuilder builder) {
    return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

TEST(Seat, AGoodbyeIsHeardThatWasSaidBeforeTheNextTickWasShown) {
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    std::optional<FrameChannel> driver(std::in_place, ends[1], 1 << 20);
    Seat seat("ego", FrameChannel(ends[0], 1 << 16), {10.0});
    flatbuffers::FlatBufferBuilder ready;
    ready.Finish(CreateReady(ready, wire_version));
    driver->send(Kind::ready, said(std::move(ready)));
    ASSERT_FALSE(seat.take(7, recording()));
    ASSERT_FALSE(seat.show(tick(1)));
    flatbuffers::FlatBufferBuilder control;
    control.Finish(CreateControl(control, 1, 0.5));
    driver->send(Kind::control, said(std::move(control)));
    flatbuffers::FlatBufferBuilder goodbye;
    goodbye.Finish(
        CreateGoodbye(goodbye, goodbye.CreateString("enough"), goodbye.CreateString("ended")));
    driver->send(Kind::goodbye, said(std::move(goodbye)));
    driver->receive({10.0});  // hello; and the tick, so that all is read when it goes
    driver->receive({10.0});
    driver.reset();

    EXPECT_TRUE(std::holds_alternative<world::Control>(seat.answer()));
    EXPECT_FALSE(seat.show(tick(2)));
    const auto last = seat.answer();
    const auto* gone = std::get_if<Lost>(&last);
    ASSERT_NE(gone, nullptr);
    EXPECT_TRUE(gone->left);
    EXPECT_EQ(gone->reason, "the driver of 'ego' left: enough");
}

/// A seat and the driver's end of its connection; the driver is ready.
struct Manned {
    explicit Manned(const Spawned& spawned = {}) {
        flatbuffers::FlatBufferBuilder ready;
        ready.Finish(CreateReady(ready, wire_version));
        driver.send(Kind::ready, said(std::move(ready)));
        EXPECT_FALSE(seat.take(7, recording(), spawned));
        EXPECT_EQ(driver.receive({10.0}).kind, Kind::hello);
    }

    static std::array<int, 2> connected() {
        std::array<int, 2> both{};
        EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, both.data()), 0);
        return both;
    }

    std::array<int, 2> ends = connected();
    FrameChannel driver{ends[1], 1 << 20};
    Seat seat{"ego", FrameChannel(ends[0], 1 << 16), {10.0}};
};

TEST(Seat, OnlyWhoSaysEndedHasNotFailed) {
    for (const std::string verdict : {"", "passed", "endeded", "driver_lost"}) {
        Manned manned;
        ASSERT_FALSE(manned.seat.show(tick(1)));
        flatbuffers::FlatBufferBuilder goodbye;
        goodbye.Finish(
            CreateGoodbye(goodbye, goodbye.CreateString("enough"), goodbye.CreateString(verdict)));
        manned.driver.send(Kind::goodbye, said(std::move(goodbye)));
        const auto last = manned.seat.answer();
        const auto* gone = std::get_if<Lost>(&last);
        ASSERT_NE(gone, nullptr);
        EXPECT_FALSE(gone->left) << verdict;
    }
}

TEST(Seat, ATickThatPassedIsToldOnceWithTheNextThatIsShown) {
    world::CommandT spawn;
    spawn.duration = 0.1;  // [s] two ticks
    Manned manned({&spawn, 1, 1, ""});
    std::vector<std::vector<std::uint64_t>> told;
    for (std::uint64_t index = 1; index <= 5; ++index) {
        ASSERT_FALSE(manned.seat.show(tick(index)));
        if (!manned.seat.rhythm().shows(index))
            continue;
        const Frame frame = manned.driver.receive({10.0});
        ASSERT_EQ(frame.kind, Kind::observation);
        told.emplace_back();
        if (const auto* passed = frame.as<Observation>().passed())
            for (const PassedTick* one : *passed)
                told.back().push_back(world::GetTick(one->tick()->data())->index());
        flatbuffers::FlatBufferBuilder control;
        control.Finish(CreateControl(control, index, 0.5));
        manned.driver.send(Kind::control, said(std::move(control)));
        EXPECT_TRUE(std::holds_alternative<world::Control>(manned.seat.answer()));
    }
    EXPECT_THAT(told,
                testing::ElementsAre(
                    testing::IsEmpty(), testing::ElementsAre(2U), testing::ElementsAre(4U)));
}

TEST(Client, ARunOfAnotherVersionIsTold) {
    std::array<int, 2> ends{};
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    FrameChannel run(ends[0], 1 << 16);
    flatbuffers::FlatBufferBuilder hello;
    hello.Finish(CreateHello(hello, wire_version + 1));
    run.send(Kind::hello, said(std::move(hello)));
    try {
        const Client driver(FrameChannel(ends[1], 1 << 16), 0);
        FAIL() << "it drives";
    } catch (const world::Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("the run speaks version 2 of the wire, this driver 1"));
    }
    EXPECT_EQ(run.receive({10.0}).kind, Kind::ready) << "which says the driver's version";
}

/// A socket or a port: where a driver comes to.
class Door : public testing::TestWithParam<const char*> {
  protected:
    SeatPlan plan() const {
        SeatPlan plan{"ego"};
        if (GetParam() == std::string("Port"))
            plan.port = 0;
        else
            plan.socket = testing::TempDir() + "seat_door_" + std::to_string(getpid());
        return plan;
    }

    /// What a driver hears that is not let in.
    static std::string refusal(const std::string& place) {
        try {
            const Client second(place);
        } catch (const world::Error& error) {
            return error.what();
        }
        return "";
    }
};

TEST_P(Door, TheFirstDrivesAndEverybodyElseIsToldWhyNot) {
    Seat seat(plan(), {10.0});
    const std::string place = seat.place();
    std::vector<std::string> told;
    std::thread driver([&] {
        Client run(place);
        while (run.next()) {
            told.push_back(refusal(place));  // somebody else comes, while we are waited for
            run.say({.throttle = 0.5});
        }
    });
    const auto taken = seat.take(3, recording());
    EXPECT_FALSE(taken) << taken->reason;
    for (std::uint64_t index = 1; index <= 2; ++index) {
        EXPECT_FALSE(seat.show(tick(index)));
        EXPECT_TRUE(std::holds_alternative<world::Control>(seat.answer()));
    }
    seat.leave("done");
    driver.join();
    EXPECT_THAT(told,
                testing::ElementsAre("'ego' has a driver already: it was here first",
                                     "'ego' has a driver already: it was here first"));
    EXPECT_THAT(refusal(place), HasSubstr("nobody is there"));
}

void drive_a_tick(Seat& seat) {
    const auto taken = seat.take(3, recording());
    EXPECT_FALSE(taken) << taken->reason;
    if (!taken) {
        EXPECT_FALSE(seat.show(tick(1)));
        EXPECT_TRUE(std::holds_alternative<world::Control>(seat.answer()));
    }
    seat.leave("done");
}

/// As another run does that was told the same place, and wants to know whether somebody is there.
TEST_P(Door, WhoHangsUpBeforeItIsReadyWasNoDriver) {
    Seat seat(plan(), {10.0});
    close(open_connection(seat.place()));
    std::thread driver([&] {
        Client run(seat.place());
        while (run.next())
            run.say({.throttle = 0.5});
    });
    drive_a_tick(seat);
    driver.join();
}

TEST_P(Door, WhoComesForEpisodesWasNoDriver) {
    Seat seat(plan(), {10.0});
    std::string told;
    std::thread others([&] {
        try {
            const Simulation client({.address = seat.place()});
        } catch (const world::Error& error) {
            told = error.what();
        }
        Client run(seat.place());
        while (run.next())
            run.say({.throttle = 0.5});
    });
    drive_a_tick(seat);
    others.join();
    EXPECT_EQ(told, "no server is there, but a run that waits for a driver");
}

TEST(Seat, WhomTheUserWaitsForNoLongerHearsGoodbye) {
    const std::string path = testing::TempDir() + "seat_stop_" + std::to_string(getpid());
    std::atomic<bool> is_over = false;
    std::string heard;
    {
        Seat seat({"ego", "", path}, {10.0, [&] { return is_over.load(); }});
        std::thread driver([&] {
            try {
                Client run(path);
                run.next();
                while (!is_over) {  // it thinks, and is thinking still when the user gives up
                }
                heard = run.next() ? "a tick" : "goodbye";
            } catch (const world::Error& error) {
                heard = error.what();
            }
        });
        EXPECT_FALSE(seat.take(3, recording()));
        EXPECT_FALSE(seat.show(tick(1)));
        is_over = true;
        EXPECT_TRUE(std::holds_alternative<Lost>(seat.answer()));
        seat.leave("the run ended");
        driver.join();
    }
    EXPECT_EQ(heard, "goodbye");
}

TEST_P(Door, WhoWaitsForARunThatEndsBeforeHearsSo) {
    Seat seat(plan(), {10.0});
    FrameChannel early(open_connection(seat.place()), 1 << 20);
    seat.leave("the run ended");
    const Frame frame = early.receive({10.0});
    ASSERT_EQ(frame.kind, Kind::fault);
    EXPECT_EQ(frame.as<remote::Fault>().text()->str(), "the run ended before 'ego' was there");
}

INSTANTIATE_TEST_SUITE_P(Each, Door, testing::Values("Socket", "Port"), [](const auto& info) {
    return std::string(info.param);
});

TEST(Seat, SocketsAreTheirOwnersOnly) {
    const std::string path = testing::TempDir() + "seat_mode_" + std::to_string(getpid());
    const Seat seat({"ego", "", path}, {0.1});
    EXPECT_EQ(std::filesystem::status(path).permissions() & std::filesystem::perms::mask,
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

/// What is said of a socket that cannot be made there.
std::string refusal_of(const std::filesystem::path& path) {
    try {
        const Seat seat({"ego", "", path}, {0.1});
    } catch (const world::Error& error) {
        return error.what();
    }
    return "";
}

TEST(Seat, APathWhereSomethingLiesIsRefusedAndLeftAlone) {
    namespace fs = std::filesystem;
    const fs::path folder = testing::TempDir() + "seat_taken_" + std::to_string(getpid());
    fs::create_directory(folder);
    EXPECT_THAT(refusal_of(folder),
                HasSubstr("cannot listen there: a folder is there, and stays: expected a path "
                          "where nothing is yet"));
    EXPECT_TRUE(fs::is_directory(folder));
    std::ofstream(folder / "notes") << "mine";
    EXPECT_THAT(refusal_of(folder / "notes"), HasSubstr("notes: cannot listen there: a file is"));
    EXPECT_EQ(fs::file_size(folder / "notes"), 4U);
    fs::create_symlink("nowhere", folder / "link");
    EXPECT_THAT(refusal_of(folder / "link"), HasSubstr("a link is there"));
    const Seat other({"ego", "", folder / "s"}, {0.1});
    EXPECT_THAT(refusal_of(folder / "s"), HasSubstr("another program listens there"));
    EXPECT_THAT(refusal_of(folder / "no\nfolder" / "s"),
                HasSubstr("no\\x0afolder/s: cannot listen there: No such file"));
    fs::remove_all(folder);
}

TEST(SeatPlan, IsReadFromWhatTheUserSays) {
    EXPECT_EQ(parse_seat("ego=python3 a.py --fast=1").command, "python3 a.py --fast=1");
    EXPECT_EQ(parse_seat("ego=python3 a.py").actor, "ego");
    EXPECT_EQ(parse_seat("ego=socket:/tmp/a").socket, "/tmp/a");
    EXPECT_EQ(parse_seat("ego=tcp:2000").port, 2000);
    EXPECT_EQ(parse_seat("ego=tcp:0").port, 0);
    for (const char* wrong : {"ego",
                              "=x",
                              "ego=",
                              "ego=socket:",
                              "ego=tcp:",
                              "ego=tcp:70000",
                              "ego=tcp:-1",
                              "ego=tcp:1.2.3.4:5"})
        EXPECT_THROW(parse_seat(wrong), world::Error) << wrong;
    EXPECT_THAT([] { parse_seat("a\nb=tcp:x"); },
                testing::ThrowsMessage<world::Error>(HasSubstr("--driver a\\x0ab=tcp:x: ")));
}

}  // namespace
}  // namespace reprise::remote

#include "remote/mailbox.h"

#include <array>
#include <cstring>
#include <fcntl.h>
#include <random>
#include <string>
#include <sys/mman.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "remote/frame_channel.h"
#include "world/check.h"

namespace reprise::remote {
namespace {

using testing::HasSubstr;

Descriptor copy_of(int descriptor) {
    return Descriptor(fcntl(descriptor, F_DUPFD_CLOEXEC, 0));
}

/// Both ends of a wire, and what a driver handed over.
struct Wire {
    Wire() {
        std::array<int, 2> ends{};
        EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
        run.emplace(ends[0], 4 << 20);
        driver.emplace(ends[1], 4 << 20);
        auto mailbox = std::make_unique<Mailbox>();
        memory = copy_of(mailbox->descriptor());
        run->use(std::make_unique<Mailbox>(copy_of(mailbox->descriptor())));
        driver->use(std::move(mailbox));
    }

    std::optional<FrameChannel> run;
    std::optional<FrameChannel> driver;
    Descriptor memory;
};

void say(FrameChannel& channel, std::uint64_t number, std::size_t filling = 0) {
    flatbuffers::FlatBufferBuilder builder;
    const auto text = builder.CreateString(std::string(filling, 'x'));
    builder.Finish(CreateGoodbye(builder, text, 0, number));
    channel.send(Kind::goodbye, {builder.GetBufferPointer(), builder.GetSize()});
}

std::uint64_t hear(FrameChannel& channel) {
    return channel.receive({10.0}).as<Goodbye>().ticks();
}

/// [bytes]
int unread_at_socket(const FrameChannel& channel) {
    std::array<char, 64> bytes{};
    return static_cast<int>(
        recv(channel.descriptor(), bytes.data(), bytes.size(), MSG_PEEK | MSG_DONTWAIT));
}

TEST(Mailbox, CarriesMessagesPastTheSocketOnceTheRunHasUsedIt) {
    Wire wire;
    say(*wire.driver, 1);
    EXPECT_GT(unread_at_socket(*wire.run), 0) << "a run may not look there";
    EXPECT_EQ(hear(*wire.run), 1U);
    say(*wire.run, 2);
    EXPECT_LT(unread_at_socket(*wire.driver), 0);
    EXPECT_TRUE(wire.driver->has_input());
    EXPECT_EQ(hear(*wire.driver), 2U);
    EXPECT_FALSE(wire.driver->has_input());
    say(*wire.driver, 3);
    EXPECT_LT(unread_at_socket(*wire.run), 0);
    EXPECT_EQ(hear(*wire.run), 3U);
}

TEST(Mailbox, LeavesToTheSocketWhatIsLongOrComesTooSoon) {
    Wire wire;
    say(*wire.run, 0);
    EXPECT_EQ(hear(*wire.driver), 0U);
    say(*wire.driver, 1, Mailbox::to_run);
    EXPECT_GT(unread_at_socket(*wire.run), 0);
    say(*wire.driver, 2);
    EXPECT_EQ(hear(*wire.run), 1U);
    EXPECT_EQ(hear(*wire.run), 2U);
    EXPECT_LT(unread_at_socket(*wire.run), 0);
    say(*wire.run, 3);
    say(*wire.run, 4);
    EXPECT_GT(unread_at_socket(*wire.driver), 0);
    EXPECT_EQ(hear(*wire.driver), 3U);
    EXPECT_EQ(hear(*wire.driver), 4U);
}

TEST(Mailbox, LeavesToTheSocketWhatIsForOneWhoSleeps) {
    Mailbox driver;
    Mailbox run(copy_of(driver.descriptor()));
    const std::array<std::uint8_t, 3> body{1, 2, 3};
    driver.sleep(true);
    EXPECT_FALSE(run.put(Kind::goodbye, body));
    driver.sleep(false);
    EXPECT_TRUE(run.put(Kind::goodbye, body));
    const auto letter = driver.take();
    ASSERT_TRUE(letter);
    EXPECT_EQ(letter->size, 3U);
    EXPECT_EQ(std::memcmp(letter->words.data(), body.data(), 3), 0);
    EXPECT_FALSE(driver.take()) << "it comes once";
}

/// So many messages from one end, in bursts, to which the other one answers burst by burst.
/// `polling` [s] of who answers.
void exchange(Wire& wire, unsigned count, double polling) {
    wire.driver->poll_for(polling);
    wire.run->poll_for(20e-6);
    std::thread driver([&] {
        std::uint64_t next = 0;
        while (next < count)
            for (std::uint64_t burst = 1 + next % 3; burst > 0 && next < count; --burst, ++next) {
                EXPECT_EQ(hear(*wire.driver), next);
                say(*wire.driver, next, next % 7 == 0 ? Mailbox::to_run : 0);
            }
    });
    std::mt19937 random(count);  // when who sleeps is what decides the way
    std::uint64_t next = 0;
    while (next < count) {
        const std::uint64_t begin = next;
        for (std::uint64_t burst = 1 + next % 3; burst > 0 && next < count; --burst, ++next)
            say(*wire.run, next, next % 101 == 0 ? Mailbox::to_driver : 0);
        for (std::uint64_t heard = begin; heard < next; ++heard)
            ASSERT_EQ(hear(*wire.run), heard);
        for (auto pause = random() % 4000; pause > 0; --pause)
            std::atomic_signal_fence(std::memory_order_seq_cst);
    }
    driver.join();
}

TEST(Mailbox, KeepsTheOrderWhicheverWayAMessageTakes) {
    for (const double polling : {0.0, 1e-6, 10e-6, 5e-3}) {
        Wire wire;
        exchange(wire, 20'000, polling);
    }
}

TEST(Mailbox, RefusesWhatIsNoSuchMemory) {
    EXPECT_THROW(Mailbox{Descriptor()}, world::Error);
    Descriptor unsealed(memfd_create("test", MFD_CLOEXEC));
    ASSERT_EQ(ftruncate(unsealed.number(), static_cast<off_t>(Mailbox::bytes())), 0);
    EXPECT_THROW(Mailbox{std::move(unsealed)}, world::Error);
    const SharedMemory small(Mailbox::bytes() - 1);
    EXPECT_THROW(Mailbox{copy_of(small.descriptor())}, world::Error);
}

/// What becomes of a run whose driver writes there what it likes.
std::string heard_of(Wire& wire) {
    try {
        wire.run->receive({0.05});
        return "a message";
    } catch (const ChannelFault& fault) {
        return fault.what();
    }
}

TEST(Mailbox, IsNoDangerToARunWhateverADriverWritesThere) {
    std::mt19937 random(7);
    for (int round = 0; round < 12; ++round) {
        Wire wire;
        SharedMemory all(copy_of(wire.memory.number()), Mailbox::bytes(), SharedMemory::Use::write);
        const auto words = all.writable().first(Mailbox::bytes() - Mailbox::to_driver);
        for (std::uint8_t& byte : words)
            byte = static_cast<std::uint8_t>(round % 2 == 0 ? random() : random() % 2);
        if (round % 4 == 1) {  // a letter, the first one, of a length and a kind that are none
            const std::array<std::uint32_t, 5> place{1, 0, 0, 99, 0xffff'ffffU};
            std::memcpy(&all.writable()[64], place.data(), sizeof(place));
            EXPECT_THAT(heard_of(wire), HasSubstr("said what is no message (kind 99, 4096 bytes)"));
        } else {
            EXPECT_THAT(heard_of(wire),
                        testing::AnyOf("said nothing in time", HasSubstr("no message")));
        }
        say(*wire.run, 1);
    }
}

}  // namespace
}  // namespace reprise::remote

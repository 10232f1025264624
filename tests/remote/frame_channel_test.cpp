#include "remote/frame_channel.h"

#include <array>
#include <cstring>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace reprise::remote {
namespace {

using testing::HasSubstr;

struct Pair {
    Pair() {
        std::array<int, 2> ends{};
        EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
        near.emplace(ends[0], 1 << 20);
        far.emplace(ends[1], 1 << 20);
    }

    std::optional<FrameChannel> near;
    std::optional<FrameChannel> far;
};

flatbuffers::FlatBufferBuilder goodbye(const std::string& reason) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(CreateGoodbye(builder, builder.CreateString(reason)));
    return builder;
}

std::string fault_of_receiving(FrameChannel& channel, std::optional<double> patience = {}) {
    try {
        channel.receive({patience});
    } catch (const ChannelFault& fault) {
        return fault.what();
    }
    return "";
}

TEST(FrameChannel, CarriesAMessageLargerThanTheSocketsBuffer) {
    Pair pair;
    const std::string reason(900'000, 'x');
    const auto builder = goodbye(reason);
    std::thread writer([&] {
        pair.near->send(Kind::goodbye, {builder.GetBufferPointer(), builder.GetSize()});
    });
    const Frame frame = pair.far->receive();
    writer.join();
    ASSERT_EQ(frame.kind, Kind::goodbye);
    EXPECT_EQ(frame.as<Goodbye>().reason()->str(), reason);
}

TEST(FrameChannel, SaysThatTheOtherEndHasHungUp) {
    Pair pair;
    pair.near.reset();
    EXPECT_EQ(fault_of_receiving(*pair.far), "has hung up");
}

TEST(FrameChannel, WaitsNoLongerThanItIsTold) {
    Pair pair;
    EXPECT_EQ(fault_of_receiving(*pair.far, 0.01), "said nothing in time");
}

TEST(FrameChannel, RefusesALengthBeforeItReadsIt) {
    Pair pair;
    const std::array<std::uint32_t, 2> header{0xffff'fff0U, 4};
    ASSERT_EQ(send(pair.near->descriptor(), header.data(), sizeof(header), 0), 8);
    EXPECT_THAT(fault_of_receiving(*pair.far),
                HasSubstr("4294967280 bytes, where 1048576 is the most"));
}

TEST(FrameChannel, TakesWhatIsAsLargeAsItIsToldAndNotAByteMore) {
    const auto message = goodbye("why");
    for (const std::size_t largest : {message.GetSize(), message.GetSize() - 1}) {
        std::array<int, 2> ends{};
        ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
        FrameChannel near(ends[0], 1 << 20);
        FrameChannel far(ends[1], largest);
        near.send(Kind::goodbye, {message.GetBufferPointer(), message.GetSize()});
        if (largest == message.GetSize())
            EXPECT_EQ(far.receive({10.0}).kind, Kind::goodbye);
        else
            EXPECT_THAT(fault_of_receiving(far), HasSubstr("is the most"));
    }
}

TEST(FrameChannel, RefusesABodyThatIsNoTableOfItsKind) {
    Pair pair;
    const std::array<std::uint32_t, 4> frame{8, 4, 0xffff'ffffU, 7};
    ASSERT_EQ(send(pair.near->descriptor(), frame.data(), sizeof(frame), 0), 16);
    EXPECT_THAT(fault_of_receiving(*pair.far),
                HasSubstr("said what is no message (kind 4, 8 bytes)"));
}

TEST(FrameChannel, RefusesAnUnknownKind) {
    Pair pair;
    const auto builder = goodbye("why");
    pair.near->send(static_cast<Kind>(77), {builder.GetBufferPointer(), builder.GetSize()});
    EXPECT_THAT(fault_of_receiving(*pair.far), HasSubstr("kind 77"));
}

TEST(FrameChannel, ThatReadsWholeMessagesLosesNoneOfWhatItReadTooFar) {
    for (const bool whole : {false, true}) {
        Pair pair;
        if (whole)
            pair.far->read_whole_messages();
        // A long one, after which three short ones fit into what is taken at once.
        const std::vector<std::string> said{
            std::string(150, 'a'), "b", "c", "d", std::string(900, 'e'), "f"};
        for (const std::string& reason : said) {
            const auto builder = goodbye(reason);
            pair.near->send(Kind::goodbye, {builder.GetBufferPointer(), builder.GetSize()});
        }
        for (const std::string& reason : said) {
            EXPECT_TRUE(pair.far->has_input());
            EXPECT_EQ(pair.far->receive().as<Goodbye>().reason()->str(), reason);
        }
        EXPECT_FALSE(pair.far->has_input());
        EXPECT_EQ(fault_of_receiving(*pair.far, 0.01), "said nothing in time");
        const auto last = goodbye("last");
        pair.near->send(Kind::goodbye, {last.GetBufferPointer(), last.GetSize()});
        EXPECT_EQ(pair.far->receive().as<Goodbye>().reason()->str(), "last");
    }
}

TEST(FrameChannel, ThatReadsWholeMessagesTakesThemInPieces) {
    Pair pair;
    pair.far->read_whole_messages();
    const auto builder = goodbye("a word");
    std::vector<std::uint8_t> bytes(8 + builder.GetSize());
    const std::array<std::uint32_t, 2> header{builder.GetSize(),
                                              static_cast<std::uint32_t>(Kind::goodbye)};
    std::memcpy(bytes.data(), header.data(), sizeof(header));
    std::memcpy(bytes.data() + 8, builder.GetBufferPointer(), builder.GetSize());
    for (int message = 0; message < 2; ++message) {
        std::thread writer([&] {
            for (const std::uint8_t byte : bytes)
                ASSERT_EQ(send(pair.near->descriptor(), &byte, 1, 0), 1);
        });
        EXPECT_EQ(pair.far->receive().as<Goodbye>().reason()->str(), "a word");
        writer.join();
    }
}

}  // namespace
}  // namespace reprise::remote

#include "remote/frame_channel.h"

#include <array>
#include <sys/socket.h>
#include <thread>

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

}  // namespace
}  // namespace reprise::remote

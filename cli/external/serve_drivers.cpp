#include "cli/external/serve_drivers.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>

#include <fmt/format.h>

#include "world/check.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

constexpr std::size_t most_drivers = 64;          // two descriptors each
constexpr std::size_t largest_answer = 64 << 10;  // [bytes] of a driver, see remote/seat.cpp
constexpr double patience_for_last_word = 1;      // [s]

void say_last(remote::FrameChannel& client,
              remote::Kind kind,
              const flatbuffers::FlatBufferBuilder& builder) {
    try {
        client.send(
            kind, {builder.GetBufferPointer(), builder.GetSize()}, {patience_for_last_word});
    } catch (const remote::ChannelFault&) {
        // It has gone by itself.
    }
}

}  // namespace

std::vector<std::string> drivers_of(const remote::Reset& reset,
                                    const remote::FrameChannel& client) {
    std::vector<std::string> names;
    if (reset.drivers() == nullptr)
        return names;
    if (reset.drivers()->size() > most_drivers)
        throw world::Error(fmt::format("reset: at most {} drivers", most_drivers));
    for (const flatbuffers::String* name : *reset.drivers()) {
        if (name->size() == 0 || std::count(names.begin(), names.end(), name->str()) != 0)
            throw world::Error("reset: each driver needs the name of another actor");
        names.push_back(name->str());
    }
    if (!names.empty() && !client.carries_descriptors())
        throw world::Error(
            "reset: several drivers need a server at a Unix domain socket (--socket), not a port");
    return names;
}

remote::FrameChannel channel_for(const std::string& name, remote::FrameChannel& client) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw world::Error(std::string("no socket: ") + std::strerror(errno));
    remote::FrameChannel ours(ends[0], largest_answer);
    const remote::Descriptor theirs(ends[1]);
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(remote::CreateChannel(builder, builder.CreateString(name)));
    client.send(remote::Kind::channel,
                {builder.GetBufferPointer(), builder.GetSize()},
                {patience_for_last_word},
                theirs.number());
    return ours;
}

bool is_left(const remote::FrameChannel& client) {
    pollfd one{client.descriptor(), POLLIN, 0};
    return poll(&one, 1, 0) > 0;
}

bool has_gone(const remote::FrameChannel& client) {
    char first = 0;
    const ssize_t got = recv(client.descriptor(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
    return got == 0 || (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK);
}

void say_end(remote::FrameChannel& client, const world::Outcome& outcome) {
    flatbuffers::FlatBufferBuilder builder;
    const auto reason = builder.CreateString(outcome.reason);
    builder.Finish(remote::CreateGoodbye(
        builder, reason, builder.CreateString(outcome.verdict), outcome.ticks));
    say_last(client, remote::Kind::goodbye, builder);
}

void say_fault(remote::FrameChannel& client, const std::string& text, std::uint32_t line) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(
        remote::CreateFault(builder, builder.CreateString(world::printable(text)), line));
    say_last(client, remote::Kind::fault, builder);
}

}  // namespace reprise::cli

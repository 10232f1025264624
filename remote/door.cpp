#include "remote/door.h"

#include <poll.h>
#include <utility>

#include <fmt/format.h>

#include "remote/wire_generated.h"
#include "world/printable.h"

namespace reprise::remote {

namespace {

constexpr const char* this_machine = "127.0.0.1";
constexpr std::size_t largest_first_word = 64 << 10;  // [bytes]
constexpr int most_at_once = 16;                      // that are turned away before we go on

/// Closes the connection.
void refuse(int descriptor, const std::string& why) {
    FrameChannel channel(descriptor, largest_first_word);
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(CreateFault(builder, builder.CreateString(world::printable(why))));
    try {
        channel.send(Kind::fault, {builder.GetBufferPointer(), builder.GetSize()}, {0.1});
    } catch (const ChannelFault&) {
        // It has gone by itself.
    }
}

}  // namespace

Door::Door(const std::filesystem::path& path, std::string actor)
    : path_(path),
      actor_(std::move(actor)),
      listener_(path, "--driver socket:") {}

Door::Door(std::uint16_t port, std::string actor)
    : actor_(std::move(actor)),
      listener_(this_machine, port) {}

std::string Door::place() const {
    return path_.empty() ? fmt::format("{}:{}", this_machine, listener_.port()) : path_.string();
}

/// The file's mode says who may come to a socket; to a port anybody of this machine can.
bool Door::may_come(int descriptor) const {
    return !path_.empty() || is_of_our_user(descriptor);
}

int Door::let_in(const Patience& patience) {
    for (;;) {
        const int descriptor = listener_.accept_one(patience);
        if (may_come(descriptor))
            return descriptor;
        refuse(descriptor, "this run is another user's");
    }
}

void Door::turn_others_away(bool is_over) {
    const std::string why =
        is_over ? fmt::format("the run ended before '{}' was there", actor_)
                : fmt::format("'{}' has a driver already: it was here first", actor_);
    for (int count = 0; count < most_at_once; ++count) {
        pollfd one{listener_.descriptor(), POLLIN, 0};
        if (poll(&one, 1, 0) <= 0)
            return;
        try {
            refuse(listener_.accept_one({1.0}), why);
        } catch (const ChannelFault&) {
            return;  // it went as soon as it came
        }
    }
}

}  // namespace reprise::remote

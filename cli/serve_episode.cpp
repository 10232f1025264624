#include "cli/serve_episode.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>

#include "cli/seats.h"
#include "files/ending.h"
#include "replay/trace_writer.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

constexpr std::size_t largest_in_place = 2 << 20;  // [bytes] a reset in place of a control
constexpr const char* driven = "ego";
constexpr double patience = 1;  // [s] for a client to take our last word

remote::FrameChannel copy_of(const remote::FrameChannel& client) {
    const int descriptor = fcntl(client.descriptor(), F_DUPFD_CLOEXEC, 0);
    if (descriptor < 0)
        throw world::Error(std::string("no descriptor is left: ") + std::strerror(errno));
    return {descriptor, largest_in_place};
}

/// Whether the client ended the episode, and did not fail in it.
bool is_ended_by_client(const Seats& seats) {
    if (!seats.loss() || !seats.loss()->said)
        return false;
    const remote::Kind kind = seats.loss()->said->kind;
    return kind == remote::Kind::reset || kind == remote::Kind::goodbye;
}

/// How the episode ended. A client that begins another one, or says goodbye, ends it; one that is
/// gone, or breaks the rules, is a lost driver.
world::Outcome outcome_of(const kernel::Kernel& kernel,
                          const Seats& seats,
                          const files::StopRequest& stop,
                          std::uint64_t ticks) {
    if (kernel.finished())
        return kernel.outcome();
    if (stop.signal() != 0)
        return world::outcome_of_ended_by_server(ticks);
    return is_ended_by_client(seats) ? world::outcome_of_ended_by_client(ticks)
                                     : world::outcome_of_lost_driver(driven, ticks);
}

/// Why there is no next tick, to a client that waits for one: it may be there still.
void tell(const remote::FrameChannel& client, const std::string& reason) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(remote::CreateFault(builder, builder.CreateString(reason)));
    try {
        copy_of(client).send(
            remote::Kind::fault, {builder.GetBufferPointer(), builder.GetSize()}, {patience});
    } catch (const remote::ChannelFault&) {
        // It has gone, or reads nothing.
    }
}

void play_on(kernel::Kernel& kernel,
             const world::Recording& recording,
             Seats& seats,
             const files::StopRequest& stop,
             const remote::FrameChannel& client,
             const std::filesystem::path& path) {
    std::optional<replay::TraceWriter> trace;
    if (!path.empty())
        trace.emplace(path, recording);
    std::uint64_t ticks = 0;
    while (!kernel.finished() && stop.signal() == 0 && !seats.loss()) {
        const world::SealedTick& tick = kernel.step(seats.controls());
        ++ticks;
        if (trace)
            trace->append(tick);
        if (!kernel.finished())
            seats.go_on(tick, [&] { kernel.begin_step(); });
    }
    const world::Outcome outcome = outcome_of(kernel, seats, stop, ticks);
    if (trace)
        trace->close(outcome);
    if (kernel.finished())
        seats.leave(outcome.reason, outcome);
    else if (stop.signal() != 0)
        seats.fail("the server ends", 0);
    else if (is_ended_by_client(seats))
        seats.abandon();  // it is answered by who hears what it said
    else
        tell(client, seats.loss()->reason);
}

}  // namespace

std::uint32_t line_named_in(const std::string& message) {
    const auto colon = message.find(':');
    std::uint32_t line = 0;
    if (colon != std::string::npos)
        std::from_chars(message.data() + colon + 1, message.data() + message.size(), line);
    return line;
}

std::optional<remote::Frame> play_episode(kernel::Kernel& kernel,
                                          const world::Recording& recording,
                                          const remote::FrameChannel& client,
                                          const std::filesystem::path& trace) {
    const files::StopRequest stop;
    Seats seats({}, {std::nullopt, [&] { return stop.signal() != 0; }}, recording);
    seats.add(std::make_unique<remote::Seat>(
        driven, copy_of(client), remote::Patience{std::nullopt, [&] {
                                                      return stop.signal() != 0;
                                                  }}));
    try {
        play_on(kernel, recording, seats, stop, client, trace);
    } catch (const std::exception& error) {  // whatever it was, the session lives on
        seats.fail(error.what(), line_named_in(error.what()));
    }
    return is_ended_by_client(seats) ? seats.take_said() : std::nullopt;
}

}  // namespace reprise::cli

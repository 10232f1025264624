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

remote::FrameChannel copy_of(const remote::FrameChannel& client) {
    const int descriptor = fcntl(client.descriptor(), F_DUPFD_CLOEXEC, 0);
    if (descriptor < 0)
        throw world::Error(std::string("no descriptor is left: ") + std::strerror(errno));
    return {descriptor, largest_in_place};
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
    const auto& said = seats.loss()->said;
    return said && (said->kind == remote::Kind::reset || said->kind == remote::Kind::goodbye)
               ? world::outcome_of_ended_by_client(ticks)
               : world::outcome_of_lost_driver(driven, ticks);
}

void play_on(kernel::Kernel& kernel,
             const world::Recording& recording,
             Seats& seats,
             const files::StopRequest& stop,
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
    else
        seats.abandon();
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
        play_on(kernel, recording, seats, stop, trace);
    } catch (const std::exception& error) {  // whatever it was, the session lives on
        seats.fail(error.what(), line_named_in(error.what()));
    }
    return seats.take_said();
}

}  // namespace reprise::cli

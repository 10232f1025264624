#include "cli/external/serve_episode.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fcntl.h>
#include <functional>

#include "cli/external/seats.h"
#include "cli/external/serve_drivers.h"
#include "cli/external/serve_folder.h"
#include "files/ending.h"
#include "replay/trace_writer.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

constexpr std::size_t largest_in_place = 2 << 20;  // [bytes] a reset in place of a control
const std::string driven = "ego";

remote::FrameChannel copy_of(const remote::FrameChannel& client) {
    const int descriptor = fcntl(client.descriptor(), F_DUPFD_CLOEXEC, 0);
    if (descriptor < 0)
        throw world::Error(std::string("no descriptor is left: ") + std::strerror(errno));
    return {descriptor, largest_in_place};
}

/// One episode: who drives in it, and what makes it end.
struct Played {
    kernel::Kernel& kernel;
    const world::Recording& recording;
    const std::vector<std::string>&
        drivers;                  ///< over channels of their own; none: 'ego' over `client`
    remote::FrameChannel client;  ///< a copy
    const files::StopRequest stop{};
    Seats seats;

    /// Whether the client hears and speaks on its own connection, as who drives several does, and
    /// whose only vehicle was taken away: what it says ends the episode, and is heard behind it.
    bool looks_on() const { return !drivers.empty() || seats.has_client_without_car(); }

    bool is_left() const { return looks_on() && cli::is_left(client); }

    /// Whether the client ended the episode, and did not fail in it.
    bool is_ended_by_client() const {
        if (looks_on())
            return !seats.loss() && cli::is_left(client) && !has_gone(client);
        if (!seats.loss() || !seats.loss()->said)
            return false;
        const remote::Kind kind = seats.loss()->said->kind;
        return kind == remote::Kind::reset || kind == remote::Kind::goodbye;
    }

    /// How the episode ended. A client that begins another one, or says goodbye, ends it; one that
    /// is gone, or breaks the rules, is a lost driver where it has somebody on the road.
    world::Outcome outcome(std::uint64_t ticks) const {
        if (kernel.finished())
            return kernel.outcome();
        if (stop.signal() != 0)
            return world::outcome_of_ended_by_server(ticks);
        if (is_ended_by_client())
            return world::outcome_of_ended_by_client(ticks);
        const auto lost =
            seats.loss() ? std::optional(seats.loss()->actor) : seats.somebody_driven();
        return lost ? world::outcome_of_lost_driver(*lost, ticks)
                    : world::outcome_of_ended_by_client(ticks);
    }

    /// Until it is over. The trace is whole before anybody hears of the end.
    world::Outcome play(const std::filesystem::path& path);

    /// The last word to each driver, and to the client.
    void tell(const world::Outcome& outcome);
};

world::Outcome Played::play(const std::filesystem::path& path) {
    std::optional<replay::TraceWriter> trace;
    if (!path.empty())
        trace.emplace(path, recording);
    std::uint64_t ticks = 0;
    while (!kernel.finished() && stop.signal() == 0 && !is_left() && !seats.loss()) {
        const world::SealedTick& tick = kernel.step(seats.controls());
        ++ticks;
        if (trace)
            trace->append(tick);
        if (!kernel.finished())
            seats.go_on(tick, [&] { kernel.begin_step(); });
    }
    const world::Outcome ended = outcome(ticks);
    if (trace)
        trace->close(ended);
    return ended;
}

void Played::tell(const world::Outcome& outcome) {
    if (kernel.finished())
        seats.leave(outcome.reason, outcome);
    else if (stop.signal() != 0)
        seats.fail("the server ends", 0);
    else if (looks_on() || is_ended_by_client())
        seats.abandon();  // the client is answered by who hears what it said
    else
        say_fault(client, seats.loss()->reason, 0);
    if (looks_on() && (!drivers.empty() || !is_left()))
        say_end(client, outcome);
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
                                          const std::vector<std::string>& drivers,
                                          const std::filesystem::path& trace,
                                          const std::filesystem::path& folder) {
    Played played{.kernel = kernel,
                  .recording = recording,
                  .drivers = drivers,
                  .client = copy_of(client),
                  .seats = Seats({}, remote::Patience{}, recording)};
    const remote::Patience patience{std::nullopt, [&] { return played.stop.signal() != 0; }};
    try {
        for (const std::string& name : drivers)
            played.seats.add(
                std::make_unique<remote::Seat>(name, channel_for(name, played.client), patience));
        if (drivers.empty())
            played.seats.add_client(
                std::make_unique<remote::Seat>(driven, copy_of(client), patience));
        played.tell(played.play(trace));
    } catch (const std::exception& error) {  // whatever it was, the session lives on
        const std::string why = as_named_in(folder, error.what());
        played.seats.fail(why, line_named_in(why));
        if (played.looks_on())
            say_fault(played.client, why, line_named_in(why));
    }
    return drivers.empty() && played.is_ended_by_client() ? played.seats.take_said() : std::nullopt;
}

}  // namespace reprise::cli

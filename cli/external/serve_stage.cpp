#include "cli/external/serve_stage.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <utility>

#include "cli/external/serve_drivers.h"
#include "cli/external/serve_episode.h"
#include "kernel/kernel.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

using Clock = std::chrono::steady_clock;
using remote::Kind;
constexpr std::size_t largest_line = 4 << 20;  // [bytes]
constexpr double patience_when_gone = 1;       // [s] for an episode whose client has hung up
constexpr double patience_when_asked = 5;      // [s] for it to close its trace

/// Ours, and the host's.
std::array<int, 2> make_line() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw world::Error(std::string("no socket: ") + std::strerror(errno));
    return ends;
}

std::span<const std::uint8_t> body_of(const remote::Frame& frame) {
    return {reinterpret_cast<const std::uint8_t*>(frame.words.data()), frame.size};
}

template <class Table>
void send_text(remote::FrameChannel& line, Kind kind, const std::string& text) {
    flatbuffers::FlatBufferBuilder builder;
    const auto of_text = builder.CreateString(text);
    Table table(builder);
    if constexpr (std::is_same_v<Table, remote::FaultBuilder>)
        table.add_text(of_text);
    else
        table.add_reason(of_text);
    builder.Finish(table.Finish());
    line.send(kind, {builder.GetBufferPointer(), builder.GetSize()});
}

/// That the client said goodbye in the middle of an episode. On the line a goodbye is the host's
/// own, at each episode's end; so it goes up as a word that no client says there.
void send_left(remote::FrameChannel& line) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(remote::CreateReady(builder));
    line.send(Kind::ready, {builder.GetBufferPointer(), builder.GetSize()});
}

/// In the copy of the host: one episode. What the client said in place of a control goes up the
/// line.
int be_episode(kernel::Kernel& kernel,
               const Stage::Set& set,
               remote::FrameChannel& line,
               const remote::Frame& reset) {
    set.signals.release();
    try {
        const auto& asked = reset.as<remote::Reset>();
        const auto* name = asked.trace();
        const bool traced = name != nullptr && name->size() != 0;
        const auto next = play_episode(kernel,
                                       set.recording,
                                       set.client,
                                       drivers_of(asked, set.client),
                                       traced ? set.folder / name->str() : "",
                                       set.folder);
        if (next && next->kind == Kind::goodbye)
            send_left(line);
        else if (next)
            line.send(next->kind, body_of(*next));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "reprise: %s\n", error.what());
        return 1;
    }
    return 0;
}

/// In the host: a kernel, and an episode for each reset that comes down the line.
int be_host(const Stage::Set& set, remote::FrameChannel line) {
    process::impose(set.limits);
    try {
        kernel::Kernel kernel(set.recording, &set.ground);
        for (;;) {
            const remote::Frame reset = line.receive();
            process::Offshoot episode([&] { return be_episode(kernel, set, line, reset); }, false);
            const auto ended = episode.wait(std::nullopt);
            send_text<remote::GoodbyeBuilder>(line,
                                              Kind::goodbye,
                                              ended->signal != 0
                                                  ? process::reason(ended->signal, set.limits)
                                              : ended->code != 0 ? "it failed"
                                                                 : "");
        }
    } catch (const remote::ChannelFault&) {
        return 0;  // the session needs us no longer
    } catch (const std::exception& error) {
        send_text<remote::FaultBuilder>(line, Kind::fault, error.what());
        return 1;
    }
}

process::Offshoot start_host(const Stage::Set& set, const std::array<int, 2>& ends) {
    process::Offshoot host(
        [&] {
            const remote::FrameChannel not_ours(ends[0], largest_line);  // so that it can end
            return be_host(set, {ends[1], largest_line});
        },
        true);
    const remote::FrameChannel its_own(ends[1], largest_line);
    return host;
}

}  // namespace

Stage::Stage(const Set& set) : Stage(set, make_line()) {}

Stage::Stage(const Set& set, const std::array<int, 2>& ends)
    : set_(set),
      line_(ends[0], largest_line),
      host_(start_host(set, ends)) {}

/// The next frame from the host. Meanwhile: signals, and a client that hangs up.
remote::Frame Stage::wait_for_word(bool& asked_to_end) {
    constexpr int never = -1;
    std::optional<Clock::time_point> until;
    const auto within = [&](double seconds) {
        until = Clock::now() +
                std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    };
    bool client_is_gone = false;
    bool told = false;
    const auto ask = [&] {
        told = true;
        host_.ask_to_end();
        within(patience_when_asked);
    };
    for (;;) {
        std::array<pollfd, 3> all{
            pollfd{line_.descriptor(), POLLIN, 0},
            pollfd{set_.signals.descriptor(), POLLIN, 0},
            pollfd{client_is_gone ? never : set_.client.descriptor(), POLLRDHUP, 0}};
        const double left =
            until ? std::chrono::duration<double>(*until - Clock::now()).count() : 0;
        poll(all.data(), all.size(), until ? std::max(0, static_cast<int>(left * 1e3)) : never);
        if (all[0].revents != 0)
            return line_.receive();
        if (all[1].revents != 0) {
            const int signal = set_.signals.take();
            if (signal != 0 && signal != SIGCHLD && !asked_to_end) {
                asked_to_end = true;
                ask();
            }
        }
        if (all[2].revents != 0) {
            client_is_gone = true;
            if (!told)
                within(patience_when_gone);
        }
        if (until && Clock::now() >= *until) {
            if (told)
                throw world::Error("the episode did not end when it was asked to");
            ask();
        }
    }
}

Stage::End Stage::play(const remote::Frame& reset) {
    End end;
    try {
        line_.send(reset.kind, body_of(reset));
        for (;;) {
            remote::Frame word = wait_for_word(end.stopped);
            if (word.kind == Kind::fault)
                throw world::Error(word.as<remote::Fault>().text()->str());
            if (word.kind == Kind::ready) {
                end.left = true;
                continue;
            }
            if (word.kind != Kind::goodbye) {
                end.next = std::move(word);
                continue;
            }
            const std::string reason = word.as<remote::Goodbye>().reason()->str();
            if (!reason.empty())
                throw world::Error("the episode " + reason);
            return end;
        }
    } catch (const remote::ChannelFault&) {
        const auto ended = host_.wait(1.0);
        throw world::Error("the episode could not begin: its process " +
                           (ended && ended->signal != 0
                                ? process::reason(ended->signal, set_.limits)
                                : std::string("ended")));
    }
}

}  // namespace reprise::cli

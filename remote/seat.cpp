// The simulator's end of the wire.
//   must      never wait for a driver that is gone; say of each fault what it was
//   assumes   one driver a seat; it is asked once for each tick that it is shown
//   goes      start or await it, hello, ready; then tick by tick observation, control; goodbye
//   keeps     which ticks were shown and not answered, those whose frames are not there yet, and
//             those that passed since
#include "remote/seat.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "process/companion.h"
#include "remote/answer.h"
#include "remote/door.h"
#include "remote/frame_channel.h"
#include "remote/guide.h"
#include "remote/live_rig.h"
#include "remote/messages.h"
#include "remote/schema.h"
#include "remote/shared_memory.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::remote {

namespace {

constexpr std::size_t largest_answer = 64 << 10;  // [bytes]

// Twice what it takes to be woken.
constexpr double polling = 100e-6;  // [s] for an answer

}  // namespace

struct Seat::Parts {
    SeatPlan plan;
    Patience patience;
    std::function<bool()> asked;          ///< whether the user gives up
    std::optional<Door> door;             ///< in which it is the only one
    std::optional<FrameChannel> channel;  // closed before the program is waited for
    std::optional<process::Companion> program;
    std::optional<std::uint32_t> id;
    std::deque<std::uint64_t> shown;  ///< ticks without an answer yet
    std::optional<Guide> guide;       ///< once taken
    std::optional<LiveRig> rig;
    bool sees_sensors = false;
    Rhythm rhythm;  ///< once taken

    /// A tick whose frames are being rendered, or that stands behind such a one.
    struct Unshown {
        std::uint64_t index = 0;
        std::vector<std::uint8_t> tick;
        std::vector<std::uint8_t> traffic;
        bool has_frames = false;
        Guidance guidance;
    };

    std::deque<Unshown> unshown;

    /// Since the tick that was shown last.
    struct Passed {
        std::vector<std::vector<std::uint8_t>> ticks;
        std::vector<PlacedPicture> readings;  ///< of what tells what happens, at most one a sensor
    };

    Passed passed;

    /// A tick that the driver is not shown, and what was measured in it.
    void pass(std::span<const std::uint8_t> tick, std::vector<PlacedPicture> frames) {
        passed.ticks.emplace_back(tick.begin(), tick.end());
        for (PlacedPicture& frame : frames) {
            put_behind_earlier(frame);
            std::erase_if(passed.readings,
                          [&](const auto& earlier) { return earlier.sensor == frame.sensor; });
            passed.readings.push_back(std::move(frame));
        }
    }

    /// A reading has the rows of the ticks that passed as well.
    void put_behind_earlier(PlacedPicture& frame) const {
        for (const PlacedPicture& earlier : passed.readings)
            if (earlier.sensor == frame.sensor && !earlier.reading.empty()) {
                frame.reading.insert(
                    frame.reading.begin(), earlier.reading.begin(), earlier.reading.end());
                frame.size = frame.reading.size();
            }
    }

    /// A tick that the driver is shown.
    std::optional<Lost> hand_over(std::uint64_t tick,
                                  std::span<const std::uint8_t> of_tick,
                                  std::span<const std::uint8_t> of_traffic,
                                  std::vector<PlacedPicture> frames,
                                  const Guidance& guidance) {
        for (PlacedPicture& frame : frames)
            put_behind_earlier(frame);
        const auto* memory =
            !rig || channel->carries_descriptors() ? nullptr : rig->memory().bytes().data();
        const Packed observation =
            pack_observation(of_tick, of_traffic, frames, memory, guidance, passed.ticks);
        passed = {};
        return send(tick, observation);
    }

    /// Now and then while it is waited for: whether that is in vain, because its program has ended
    /// and only the socket is still open, in what it has left running.
    bool is_in_vain() {
        if (door)
            door->turn_others_away();
        return program && channel && program->wait(0) && !channel->has_input();
    }

    /// What became of it: how its program ended says more than a socket that is closed.
    Lost lost(const ChannelFault& fault) {
        using Why = ChannelFault::Why;
        std::string reason = fault.what();
        if (program)
            if (const auto ended = program->wait(fault.why == Why::hung_up ? 1 : 0);
                ended && fault.why != Why::other)
                reason = ended->signal != 0 ? fmt::format("was ended by signal {}", ended->signal)
                                            : fmt::format("ended with exit code {}", ended->code);
        // Whom the user waits for no longer has done nothing wrong, and hears goodbye.
        if (fault.why != Why::given_up || !asked || !asked())
            channel.reset();
        return {fmt::format("the driver of '{}' {}", plan.actor, reason), std::nullopt};
    }

    /// Waits for who comes to the door, if there is one.
    std::optional<Lost> let_in() {
        if (!door)
            return std::nullopt;
        try {
            Patience until_it_comes = patience;
            until_it_comes.given_up = asked;  // who comes now is not turned away
            channel.emplace(door->let_in(until_it_comes), largest_answer);
            return std::nullopt;
        } catch (const ChannelFault&) {
            return lost(ChannelFault("did not come in time"));
        }
    }

    /// Says hello and hears that it is ready. Throws ChannelFault.
    std::optional<Lost> greet(const Packed& hello, const Descriptor& memory) {
        channel->send(Kind::hello, bytes_of(hello), patience, memory.number());
        Frame frame = channel->receive(patience);
        if (frame.kind == Kind::open && door)  // and hears by our hello that we are no server
            throw ChannelFault("wants a server", ChannelFault::Why::hung_up);
        if (frame.kind != Kind::ready)
            return said_else(std::move(frame), "did not say that it is ready");
        if (const auto version = frame.as<Ready>().version(); version != wire_version)
            return lost(ChannelFault(
                fmt::format("speaks version {} of the wire, this is {}", version, wire_version)));
        channel->poll_for(polling);
        // Whose frames are waited for as well looks at descriptors only.
        if (frame.as<Ready>().mailbox() == Mailbox::bytes() && frame.descriptor.number() >= 0 &&
            !rig)
            try {
                channel->use(std::make_unique<Mailbox>(std::move(frame.descriptor)));
            } catch (const world::Error& fault) {
                return lost(ChannelFault(std::string("handed over no mailbox: ") + fault.what()));
            }
        return std::nullopt;
    }

    void say_last(Kind kind, const flatbuffers::FlatBufferBuilder& builder) {
        rig.reset();
        if (!channel)
            return;
        try {
            channel->send(kind, bytes_of(builder), {1.0});
        } catch (const ChannelFault&) {
            // Whoever left before us needs no goodbye.
        }
        channel.reset();
    }

    /// It said something else than was to be said now. What a program prints that ends thereby (a
    /// traceback) comes before our line, not into it.
    Lost said_else(Frame frame, const std::string& what) {
        if (program && frame.kind == Kind::goodbye)
            program->wait(1);
        Lost result = lost(ChannelFault(what));
        result.said = std::move(frame);
        return result;
    }

    Lost lost_renderer(const RenderFault& fault) const {
        return {fmt::format("the process that renders for '{}' {}", plan.actor, fault.what()),
                std::nullopt,
                fault.is_ours};
    }

    /// Whoever has hung up may have said why: answer() reads what is left, and finds that out.
    std::optional<Lost> send(std::uint64_t tick, const Packed& observation) {
        shown.push_back(tick);
        try {
            channel->send(Kind::observation, bytes_of(observation), patience);
        } catch (const ChannelFault& fault) {
            if (fault.why != ChannelFault::Why::hung_up)
                return lost(fault);
        }
        return std::nullopt;
    }

    /// What waits for no frame, or for such as have come meanwhile.
    std::optional<Lost> show_finished() {
        for (; !unshown.empty(); unshown.pop_front()) {
            const Unshown& next = unshown.front();
            if (next.has_frames && !rig->has(next.index))
                break;
            auto frames = next.has_frames ? rig->take() : std::vector<PlacedPicture>();
            if (!rhythm.shows(next.index))
                pass(next.tick, std::move(frames));
            else if (auto gone = hand_over(
                         next.index, next.tick, next.traffic, std::move(frames), next.guidance))
                return gone;
        }
        return std::nullopt;
    }

    /// While the driver thinks, frames of later ticks come, and are handed on.
    std::optional<Lost> wait_for_answer() {
        while (!unshown.empty() && !channel->has_input()) {
            const std::array<int, 2> both{channel->descriptor(), rig->descriptor()};
            wait_for_any_input(both, patience);
            if (channel->has_input())
                break;
            if (auto gone = show_finished())
                return gone;
        }
        return std::nullopt;
    }
};

Seat::Seat(const SeatPlan& plan, Patience patience) : parts_(std::make_unique<Parts>()) {
    Parts& parts = *parts_;
    parts.plan = plan;
    parts.patience = std::move(patience);
    parts.asked = std::move(parts.patience.given_up);
    parts.patience.given_up = [&parts] {
        return parts.is_in_vain() || (parts.asked && parts.asked());
    };
    if (!plan.socket.empty())
        parts.door.emplace(plan.socket, plan.actor);
    else if (plan.port)
        parts.door.emplace(*plan.port, plan.actor);
    if (parts.door)
        return;
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw world::Error(std::string("--driver: no socket: ") + std::strerror(errno));
    parts.channel.emplace(ends[0], largest_answer);
    parts.channel->read_whole_messages();
    const FrameChannel theirs(ends[1], largest_answer);  // closed here once the program has it
    parts.program.emplace(plan.command, theirs.descriptor(), "REPRISE_DRIVER=fd:%d");
}

Seat::Seat(std::string actor, FrameChannel channel, Patience patience)
    : parts_(std::make_unique<Parts>()) {
    parts_->plan.actor = std::move(actor);
    parts_->patience = std::move(patience);
    parts_->channel.emplace(std::move(channel));
}

Seat::~Seat() {
    leave("the run ended");
}

const std::string& Seat::actor() const {
    return parts_->plan.actor;
}

std::string Seat::place() const {
    return parts_->door ? parts_->door->place() : "";
}

std::optional<std::uint32_t> Seat::id() const {
    return parts_->id;
}

std::optional<Lost> Seat::take(std::uint32_t id,
                               const world::Recording& recording,
                               const Spawned& spawned) {
    Parts& parts = *parts_;
    parts.id = id;
    parts.guide = spawned.guide != nullptr ? *spawned.guide : Guide(recording.town, id);
    if (spawned.command != nullptr) {
        const double step = world::seconds(1, recording.episode.step_ns);
        parts.rhythm = Rhythm::of(*spawned.command, spawned.tick, spawned.now, step);
        parts.sees_sensors = spawned.command->sees_sensors;
        const world::Rig rig = world::rig_of(*spawned.command, spawned.tick, step);
        if (!rig.sensors.empty())  // it reads the town while the driver does
            parts.rig.emplace(spawned.render_program, *spawned.command, rig, recording);
        if (parts.rig && !spawned.tick_before.empty())
            parts.rig->remember(spawned.tick_before, spawned.traffic_before);
    }
    const auto route = parts.sees_sensors ? std::nullopt : parts.guide->route_left();
    for (;;) {
        if (auto nobody = parts.let_in())
            return nobody;
        const bool looks_itself = parts.rig && parts.channel->carries_descriptors();
        const Packed hello = pack_hello({id,
                                         parts.plan.actor,
                                         spawned.command,
                                         route ? &*route : nullptr,
                                         looks_itself ? parts.rig->memory().bytes().size() : 0},
                                        recording);
        const Descriptor memory = looks_itself ? parts.rig->memory().for_looking() : Descriptor();
        try {
            return parts.greet(hello, memory);
        } catch (const ChannelFault& fault) {
            // It only looked whether somebody listens there, as another run does that was told the
            // same place; or it came for episodes.
            if (!parts.door || fault.why != ChannelFault::Why::hung_up)
                return parts.lost(fault);
        }
    }
}

const Rhythm& Seat::rhythm() const {
    return parts_->rhythm;
}

std::optional<Lost> Seat::show(const world::SealedTick& tick) {
    Parts& parts = *parts_;
    if (parts.door)
        parts.door->turn_others_away();
    const std::uint64_t index = tick.view().index();
    const Guidance guidance = parts.guide->look(*tick.view().tick);
    std::vector<std::uint8_t> own;
    std::span<const std::uint8_t> of_tick = tick.tick_bytes();
    std::span<const std::uint8_t> of_traffic = tick.traffic_bytes();
    if (parts.sees_sensors) {
        own = own_tick(tick.view(), *parts.id);
        of_tick = own;
        of_traffic = {};
    }
    try {
        const bool has_frames = parts.rig && parts.rig->ask(tick);
        if (!has_frames && parts.unshown.empty()) {
            if (parts.rhythm.shows(index))
                return parts.hand_over(index, of_tick, of_traffic, {}, guidance);
            parts.pass(of_tick, {});
            return std::nullopt;
        }
        parts.unshown.push_back({index,
                                 {of_tick.begin(), of_tick.end()},
                                 {of_traffic.begin(), of_traffic.end()},
                                 has_frames,
                                 guidance});
        return parts.show_finished();
    } catch (const RenderFault& fault) {
        return parts.lost_renderer(fault);
    }
}

std::optional<Lost> Seat::show_due() {
    Parts& parts = *parts_;
    try {
        while (parts.shown.empty() && !parts.unshown.empty()) {
            parts.rig->wait_for(parts.unshown.front().index, parts.patience.given_up);
            if (auto lost = parts.show_finished())
                return lost;
        }
        return std::nullopt;
    } catch (const RenderFault& fault) {
        return parts.lost_renderer(fault);
    } catch (const ChannelFault& fault) {
        return parts.lost(fault);
    }
}

std::variant<world::Control, Lost> Seat::answer() {
    Parts& parts = *parts_;
    if (auto lost = show_due())
        return std::move(*lost);
    try {
        if (auto lost = parts.wait_for_answer())
            return std::move(*lost);
        Frame frame = parts.channel->receive(parts.patience);
        if (frame.kind == Kind::goodbye) {
            const auto* reason = frame.as<Goodbye>().reason();
            const auto* verdict = frame.as<Goodbye>().verdict();
            const bool left = verdict != nullptr && verdict->str() == "ended";
            Lost gone = parts.said_else(
                std::move(frame), "left" + (reason == nullptr ? "" : ": " + shortened(*reason)));
            gone.left = left;
            return gone;
        }
        if (frame.kind != Kind::control)
            return parts.said_else(std::move(frame), "said something else than a control");
        const Control& said = frame.as<Control>();
        if (const std::string fault = fault_of(said, parts.shown.front()); !fault.empty())
            return parts.lost(ChannelFault(fault));
        parts.shown.pop_front();
        return world::Control(said.throttle(),
                              said.brake(),
                              said.steer(),
                              *parts.id,
                              said.lamps(),
                              said.hand_brake(),
                              said.reverse());
    } catch (const RenderFault& fault) {
        return parts.lost_renderer(fault);
    } catch (const ChannelFault& fault) {
        return parts.lost(fault);
    }
}

void Seat::leave(const std::string& reason, const std::optional<world::Outcome>& outcome) {
    flatbuffers::FlatBufferBuilder builder;
    const auto why = builder.CreateString(reason);
    builder.Finish(
        outcome
            ? CreateGoodbye(builder, why, builder.CreateString(outcome->verdict), outcome->ticks)
            : CreateGoodbye(builder, why));
    parts_->say_last(Kind::goodbye, builder);
    if (parts_->door)
        parts_->door->turn_others_away(!parts_->id);
    parts_->door.reset();
}

void Seat::fail(const std::string& text, std::uint32_t line) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(CreateFault(builder, builder.CreateString(world::printable(text)), line));
    parts_->say_last(Kind::fault, builder);
}

void Seat::abandon() {
    parts_->channel.reset();
}

}  // namespace reprise::remote

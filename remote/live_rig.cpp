// What cameras see while a run goes on.
//   must      hand over each frame whole, never before its pixels are there; tell a renderer's
//   death assumes   both ends are of one build; ticks are asked for in their order goes      hello
//   with the memory; then ticks with the places for their frames, and an answer for
//             each once the pixels lie there
//   keeps     which tick was asked for last, and which answered
#include "remote/live_rig.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>

#include <fmt/format.h>

#include "process/companion.h"
#include "remote/messages.h"
#include "remote/schema.h"
#include "remote/shared_memory.h"
#include "world/check.h"

namespace reprise::remote {

namespace {

constexpr std::size_t largest_note = 16 << 20;       // [bytes] of what a renderer says
constexpr std::size_t largest_from_run = 256 << 20;  // [bytes] a town of a large city
constexpr std::string_view variable = "REPRISE_LIVE";

/// Ours, and the one that the renderer is given.
std::array<int, 2> socket_pair() {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw world::Error(std::string("no socket for the renderer: ") + std::strerror(errno));
    return ends;
}

}  // namespace

/// The exit code of programs of ours that have told what is wrong: for a renderer, no memory.
constexpr int said_itself = 2;

struct LiveRig::Parts {
    Parts(const world::Rig& rig, unsigned latency, int descriptor)
        : needs_last(world::need_last(rig.sensors)),
          ring(rig, latency),
          memory(ring.bytes()),
          channel(std::in_place, descriptor, largest_note) {}

    /// What became of it says more than a socket that is closed.
    [[noreturn]] void fail(const std::string& fault) {
        const auto ended = program->wait(1);
        if (!ended)
            throw RenderFault(fault, true);
        if (ended->signal != 0)
            throw RenderFault(fmt::format("was ended by signal {}", ended->signal), true);
        if (ended->code == said_itself)
            throw RenderFault("could not go on, and has said why", false);
        throw RenderFault(fmt::format("ended with exit code {}", ended->code), true);
    }

    void hear(const Patience& patience) {
        Frame frame;
        try {
            frame = channel->receive(patience);
        } catch (const ChannelFault& fault) {
            if (patience.given_up && patience.given_up())
                throw;
            fail(fault.what());
        }
        if (frame.kind == Kind::ready)
            return;
        const auto* pictures =
            frame.kind == Kind::observation ? frame.as<Observation>().pictures() : nullptr;
        if (pictures == nullptr || pictures->size() == 0)
            fail("said something else than pictures");
        done = pictures->Get(0)->tick();
        std::vector<PlacedPicture>& frames = answered.emplace_back();
        for (const Picture* picture : *pictures) {
            frames.push_back(
                {picture->sensor(), picture->tick(), picture->offset(), picture->size(), {}});
            if (const auto* rows = picture->data())
                frames.back().reading.assign(rows->begin(), rows->end());
        }
    }

    bool tell(std::span<const std::uint8_t> tick,
              std::span<const std::uint8_t> traffic,
              std::span<const PlacedPicture> wished) {
        const Packed wish = pack_observation(tick, traffic, wished, nullptr);
        try {
            channel->send(Kind::observation, bytes_of(wish));
        } catch (const ChannelFault&) {
            return false;
        }
        return true;
    }

    bool needs_last;
    PictureRing ring;
    SharedMemory memory;
    std::optional<process::Companion> program;  // waited for once the channel is closed
    std::optional<FrameChannel> channel;
    std::uint64_t done = 0;                           ///< the last tick whose frames are there
    std::deque<std::vector<PlacedPicture>> answered;  ///< and not taken yet
};

LiveRig::LiveRig(const std::string& program,
                 const world::CommandT& spawn,
                 const world::Rig& rig,
                 const world::Recording& recording) {
    const auto [ours, theirs] = socket_pair();
    const Descriptor handed_over(theirs);
    parts_ = std::make_unique<Parts>(rig, spawn.latency, ours);
    parts_->program.emplace(program, theirs, std::string(variable) + "=fd:%d");
    const bool on_globe =
        std::any_of(rig.sensors.begin(), rig.sensors.end(), [](const world::SensorSpec& sensor) {
            return sensor.kind == world::SensorKind::gnss;
        });
    const Packed hello = pack_hello(
        {spawn.actor, spawn.text, &spawn, nullptr, parts_->ring.bytes(), on_globe}, recording);
    try {
        parts_->channel->send(Kind::hello, bytes_of(hello), {}, parts_->memory.descriptor());
    } catch (const ChannelFault&) {
        // It is gone already: the first question says how.
    }
}

LiveRig::~LiveRig() = default;

const SharedMemory& LiveRig::memory() const {
    return parts_->memory;
}

void LiveRig::remember(std::span<const std::uint8_t> tick, std::span<const std::uint8_t> traffic) {
    if (parts_->needs_last)
        parts_->tell(tick, traffic, {});  // who is gone says so when it is asked
}

bool LiveRig::ask(const world::SealedTick& tick) {
    const std::vector<PlacedPicture> pictures = parts_->ring.of(tick.view().index());
    // Who says how things move looks at the tick before as well, whether anything is due in it.
    if (pictures.empty() && !parts_->needs_last)
        return false;
    if (!parts_->tell(tick.tick_bytes(), tick.traffic_bytes(), pictures))
        parts_->fail("has hung up");
    return !pictures.empty();
}

bool LiveRig::has(std::uint64_t tick) {
    pollfd one{descriptor(), POLLIN, 0};
    while (parts_->done < tick && poll(&one, 1, 0) > 0)
        parts_->hear({});
    return parts_->done >= tick;
}

void LiveRig::wait_for(std::uint64_t tick, const std::function<bool()>& given_up) {
    while (parts_->done < tick)
        parts_->hear({std::nullopt, given_up});
}

std::vector<PlacedPicture> LiveRig::take() {
    REPRISE_CHECK(!parts_->answered.empty(), "no frames to take");
    std::vector<PlacedPicture> frames = std::move(parts_->answered.front());
    parts_->answered.pop_front();
    return frames;
}

int LiveRig::descriptor() const {
    return parts_->channel->descriptor();
}

// --- The other side.

struct LivePictures::Parts {
    explicit Parts(int descriptor) : channel(descriptor, largest_from_run) {}

    FrameChannel channel;
    Frame last;    ///< the wish looks into it
    Frame before;  ///< and into what was told before it
    world::TownT town;
    std::string network;
    world::Rig rig;
    std::optional<SharedMemory> memory;
};

namespace {

int live_descriptor() {
    const char* told = std::getenv(variable.data());
    const std::string_view text = told == nullptr ? "" : told;
    int number = -1;
    constexpr std::string_view word = "fd:";
    if (!text.starts_with(word) ||
        std::from_chars(text.data() + word.size(), text.data() + text.size(), number).ec !=
            std::errc())
        throw world::Error("live: a run starts this by itself, for vehicles that carry a rig");
    return number;
}

}  // namespace

LivePictures::LivePictures() : parts_(std::make_unique<Parts>(live_descriptor())) {
    Parts& parts = *parts_;
    Frame frame = parts.channel.receive();
    REPRISE_CHECK(frame.kind == Kind::hello, "no hello");
    const Hello& hello = frame.as<Hello>();
    REPRISE_CHECK(hello.town() != nullptr && hello.spawn() != nullptr, "hello without a town");
    world::GetTown(hello.town()->data())->UnPackTo(&parts.town);
    if (hello.network() != nullptr)
        parts.network = hello.network()->str();
    parts.rig = world::rig_of(*flatbuffers::GetRoot<world::Command>(hello.spawn()->data()),
                              0,
                              world::seconds(1, hello.step_ns()));
    parts.memory.emplace(
        std::move(frame.descriptor), hello.shared_bytes(), SharedMemory::Use::write);
}

LivePictures::~LivePictures() = default;

const world::TownT& LivePictures::town() const {
    return parts_->town;
}

const std::string& LivePictures::network() const {
    return parts_->network;
}

const world::SensorRig& LivePictures::sensors() const {
    return parts_->rig.sensors;
}

void LivePictures::ready() {
    Packed builder;
    builder.Finish(CreateReady(builder, wire_version, builder.CreateString(schema_digest())));
    parts_->channel.send(Kind::ready, bytes_of(builder));
}

namespace {

world::TickView tick_of(const Frame& told) {
    const Observation& seen = told.as<Observation>();
    return {world::GetTick(seen.tick()->data()), world::GetTraffic(seen.traffic()->data())};
}

}  // namespace

LivePictures::Wish LivePictures::next() {
    Parts& parts = *parts_;
    do {
        parts.before = std::move(parts.last);
        parts.last = parts.channel.receive();
        REPRISE_CHECK(parts.last.kind == Kind::observation, "no tick to look at");
    } while (parts.last.as<Observation>().pictures() == nullptr);
    const Observation& seen = parts.last.as<Observation>();
    Wish wish{tick_of(parts.last), {}, {}};
    if (parts.before.kind == Kind::observation &&
        tick_of(parts.before).index() + 1 == wish.tick.index())
        wish.last = tick_of(parts.before);
    for (const Picture* picture : *seen.pictures())
        wish.sensors.push_back(parts.rig.sensors.at(picture->sensor()));
    return wish;
}

void LivePictures::show(std::span<const world::SensorFrame> frames) {
    Parts& parts = *parts_;
    const auto& wished = *parts.last.as<Observation>().pictures();
    const std::span<std::uint8_t> memory = parts.memory->writable();
    std::vector<PlacedPicture> done;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Picture& place = *wished.Get(static_cast<flatbuffers::uoffset_t>(i));
        const std::vector<std::uint8_t>& bytes = frames[i].data;
        done.push_back({place.sensor(), place.tick(), place.offset(), bytes.size(), {}});
        if (world::is_reading(frames[i].kind)) {
            done.back().reading = bytes;
            continue;
        }
        REPRISE_CHECK(bytes.size() <= place.size() && place.offset() <= memory.size() &&
                          bytes.size() <= memory.size() - place.offset(),
                      "no place for a picture");
        std::memcpy(memory.data() + place.offset(), bytes.data(), bytes.size());
    }
    parts.channel.send(Kind::observation, bytes_of(pack_observation({}, {}, done, nullptr)));
}

}  // namespace reprise::remote

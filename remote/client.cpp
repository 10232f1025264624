#include "remote/client.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "remote/connection.h"
#include "remote/frame_channel.h"
#include "remote/schema.h"
#include "remote/shared_memory.h"
#include "world/check.h"
#include "world/external/point_fields.h"
#include "world/story/wording.h"

namespace reprise::remote {

namespace {

constexpr std::size_t largest_message = 256 << 20;  // [bytes] a town of a large city
constexpr std::string_view descriptor_word = "fd:";

std::string text_of(const flatbuffers::String* text) {
    return text == nullptr ? "" : text->str();
}

int open_channel(const std::string& asked) {
    const char* told = std::getenv("REPRISE_DRIVER");
    const std::string address = !asked.empty() ? asked : told == nullptr ? "" : told;
    if (address.empty())
        throw world::Error(
            "no run to drive in: start this by reprise run SCENARIO.lua --driver NAME='...', or "
            "name a socket");
    if (!address.starts_with(descriptor_word))
        return open_connection(address);
    const std::string_view number = std::string_view(address).substr(descriptor_word.size());
    int descriptor = -1;
    const auto end = number.data() + number.size();
    if (std::from_chars(number.data(), end, descriptor).ptr != end || descriptor < 0)
        throw world::Error("REPRISE_DRIVER=" + address +
                           ": expected fd:NUMBER, a socket's path or HOST:PORT");
    return descriptor;
}

template <class Table, class Object>
void unpack(const flatbuffers::Vector<std::uint8_t>* bytes, Object& object, const char* what) {
    flatbuffers::Verifier verifier(bytes == nullptr ? nullptr : bytes->data(),
                                   bytes == nullptr ? 0 : bytes->size());
    if (bytes == nullptr || !verifier.VerifyBuffer<Table>(nullptr))
        throw world::Error(fmt::format("the run said hello without {}", world::with_article(what)));
    flatbuffers::GetRoot<Table>(bytes->data())->UnPackTo(&object);
}

template <class Table>
bool holds(const flatbuffers::Vector<std::uint8_t>* bytes) {
    if (bytes == nullptr)
        return false;
    flatbuffers::Verifier verifier(bytes->data(), bytes->size());
    return verifier.VerifyBuffer<Table>(nullptr);
}

}  // namespace

struct Client::Parts {
    explicit Parts(FrameChannel its) : channel(std::move(its)) {
        world::FinishTrafficBuffer(no_traffic, world::CreateTraffic(no_traffic));
    }

    /// Hello and ready.
    void begin() {
        Frame frame = channel.receive();
        if (frame.kind == Kind::fault)
            throw world::Error(text_of(frame.as<Fault>().text()));
        if (frame.kind == Kind::goodbye)
            throw world::Error("the run ended before there was somebody to drive");
        if (frame.kind != Kind::hello)
            throw world::Error("the run did not begin with hello");
        const Hello& hello = frame.as<Hello>();
        flatbuffers::FlatBufferBuilder builder;
        auto mailbox = make_mailbox();
        builder.Finish(CreateReady(builder,
                                   wire_version,
                                   builder.CreateString(schema_digest()),
                                   mailbox ? Mailbox::bytes() : 0));
        channel.send(Kind::ready,
                     {builder.GetBufferPointer(), builder.GetSize()},
                     {},
                     mailbox ? mailbox->descriptor() : -1);
        if (hello.version() != wire_version)
            throw world::Error(fmt::format("the run speaks version {} of the wire, this driver {}",
                                           hello.version(),
                                           wire_version));
        actor = hello.actor();
        name = hello.name() == nullptr ? "" : hello.name()->str();
        step = world::seconds(1, hello.step_ns());
        unpack<world::Town>(hello.town(), town, "town");
        unpack<world::Episode>(hello.episode(), episode, "episode");
        read_rig(hello);
        if (hello.route() != nullptr)
            unpack<world::Command>(hello.route(), route.emplace(), "route");
        if (hello.shared_bytes() > 0)
            memory.emplace(
                std::move(frame.descriptor), hello.shared_bytes(), SharedMemory::Use::look);
        if (mailbox)
            channel.use(std::move(mailbox));
    }

    /// None: over TCP, or where there is no memory for it, all goes through the socket.
    std::unique_ptr<Mailbox> make_mailbox() const {
        try {
            return channel.carries_descriptors() ? std::make_unique<Mailbox>() : nullptr;
        } catch (const world::Error&) {
            return nullptr;
        }
    }

    void read_rig(const Hello& hello) {
        if (hello.spawn() == nullptr)
            return;
        flatbuffers::Verifier verifier(hello.spawn()->data(), hello.spawn()->size());
        if (!verifier.VerifyBuffer<world::Command>(nullptr))
            throw world::Error("the run said hello with what is no command");
        rig = world::rig_of(*flatbuffers::GetRoot<world::Command>(hello.spawn()->data()), 0, step);
    }

    /// Index in the rig. Throws world::Error.
    std::size_t find(std::string_view sensor) const {
        for (std::size_t i = 0; i < rig.sensors.size(); ++i)
            if (rig.sensors[i].name == sensor)
                return i;
        throw world::Error(fmt::format("'{}' carries no sensor '{}'", name, sensor));
    }

    /// Of the last tick; null where the sensor was not due.
    const remote::Picture* shown(std::size_t sensor) const {
        const auto* pictures =
            last.kind == Kind::observation ? last.as<Observation>().pictures() : nullptr;
        if (pictures != nullptr)
            for (const remote::Picture* picture : *pictures)
                if (picture->sensor() == sensor)
                    return picture;
        return nullptr;
    }

    /// The pixels of a frame, wherever they are.
    std::span<const std::uint8_t> pixels(const remote::Picture& picture, std::size_t size) const {
        if (size == 0)
            return {};
        if (picture.data() != nullptr && picture.data()->size() == size)
            return {picture.data()->data(), size};
        if (!memory || picture.offset() > memory->bytes().size() ||
            size > memory->bytes().size() - picture.offset())
            throw world::Error("the run showed a picture without its pixels");
        return memory->bytes().subspan(picture.offset(), size);
    }

    FrameChannel channel;
    Frame last;  ///< the ticks look into it
    std::optional<SharedMemory> memory;
    world::Rig rig;
    flatbuffers::FlatBufferBuilder no_traffic;  ///< of who sees sensors only
    std::uint32_t actor = 0;
    std::uint64_t tick = 0;
    std::string name;
    double step = 0;
    world::TownT town;
    world::EpisodeT episode;
    std::optional<world::CommandT> route;
    world::Outcome outcome;
};

Client::Client(const std::string& address, double polling)
    : Client(FrameChannel(open_channel(address), largest_message), polling) {
    parts_->channel.read_whole_messages();
}

Client::Client(FrameChannel channel, double polling)
    : parts_(std::make_unique<Parts>(std::move(channel))) {
    try {
        parts_->begin();
        parts_->channel.poll_for(polling);
    } catch (const ChannelFault& fault) {
        throw world::Error(std::string("the run ") + fault.what());
    }
}

Client::~Client() = default;

std::uint32_t Client::actor() const {
    return parts_->actor;
}

const std::string& Client::name() const {
    return parts_->name;
}

double Client::step() const {
    return parts_->step;
}

const world::TownT& Client::town() const {
    return parts_->town;
}

const world::EpisodeT& Client::episode() const {
    return parts_->episode;
}

const std::optional<world::CommandT>& Client::route() const {
    return parts_->route;
}

const world::Outcome& Client::outcome() const {
    return parts_->outcome;
}

std::optional<world::TickView> Client::next() {
    Parts& parts = *parts_;
    try {
        parts.last = parts.channel.receive();
    } catch (const ChannelFault& fault) {
        throw world::Error(std::string("the run ") + fault.what());
    }
    if (parts.last.kind == Kind::fault)
        throw world::Error(text_of(parts.last.as<Fault>().text()));
    if (parts.last.kind == Kind::goodbye) {
        const Goodbye& last = parts.last.as<Goodbye>();
        parts.outcome = {text_of(last.verdict()), text_of(last.reason()), last.ticks()};
    }
    if (parts.last.kind != Kind::observation)
        return std::nullopt;
    const Observation& seen = parts.last.as<Observation>();
    bool is_whole = holds<world::Tick>(seen.tick()) &&
                    (seen.traffic() == nullptr || holds<world::Traffic>(seen.traffic()));
    if (seen.passed() != nullptr)
        for (const PassedTick* one : *seen.passed())
            is_whole = is_whole && holds<world::Tick>(one->tick());
    if (!is_whole)
        throw world::Error("the run showed what is no tick");
    const world::TickView view{
        world::GetTick(seen.tick()->data()),
        world::GetTraffic(seen.traffic() != nullptr ? seen.traffic()->data()
                                                    : parts.no_traffic.GetBufferPointer())};
    parts.tick = view.index();
    return view;
}

std::vector<const world::Tick*> Client::passed() const {
    std::vector<const world::Tick*> ticks;
    if (parts_->last.kind == Kind::observation)
        if (const auto* passed = parts_->last.as<Observation>().passed())
            for (const PassedTick* one : *passed)
                ticks.push_back(world::GetTick(one->tick()->data()));
    return ticks;
}

const world::SensorRig& Client::sensors() const {
    return parts_->rig.sensors;
}

std::optional<Client::Picture> Client::picture(std::string_view sensor) const {
    const std::size_t index = parts_->find(sensor);
    const world::SensorSpec& spec = parts_->rig.sensors[index];
    if (!world::is_camera(spec.kind))
        throw world::Error(fmt::format("'{}' is no camera: rows() has what it measured", sensor));
    if (const remote::Picture* shown = parts_->shown(index))
        return Picture{&spec, parts_->pixels(*shown, world::picture_bytes(spec))};
    return std::nullopt;
}

std::optional<Client::Rows> Client::rows(std::string_view sensor) const {
    const std::size_t index = parts_->find(sensor);
    const world::SensorSpec& spec = parts_->rig.sensors[index];
    if (world::is_camera(spec.kind))
        throw world::Error(fmt::format("'{}' is a camera: picture() has what it saw", sensor));
    const remote::Picture* shown = parts_->shown(index);
    if (shown == nullptr)
        return std::nullopt;
    const std::size_t row = world::row_bytes(spec.kind);
    return Rows{&spec, shown->size() / row, parts_->pixels(*shown, shown->size())};
}

double Client::Rows::at(std::size_t row, std::size_t column) const {
    const auto fields = world::point_fields(sensor->kind);
    REPRISE_CHECK(row < count && column < fields.size(),
                  fmt::format("row {} of {}, column {}", row, count, column));
    const auto number = [&]<typename Number>(Number value) {
        std::memcpy(
            &value, bytes.data() + (row * fields.size() + column) * sizeof(value), sizeof(value));
        return static_cast<double>(value);
    };
    if (world::is_reading(sensor->kind))
        return number(double());
    return fields[column].whole ? number(std::uint32_t()) : number(float());
}

Client::Way Client::way() const {
    if (parts_->last.kind != Kind::observation)
        return {};
    const Observation& seen = parts_->last.as<Observation>();
    return {seen.turning(), seen.way_to_goal()};
}

void Client::leave(const std::string& reason) {
    flatbuffers::FlatBufferBuilder builder;
    const auto why = builder.CreateString(reason);
    builder.Finish(CreateGoodbye(builder, why, builder.CreateString("ended")));
    try {
        parts_->channel.send(Kind::goodbye, {builder.GetBufferPointer(), builder.GetSize()});
    } catch (const ChannelFault&) {
        // Who is gone needs no goodbye.
    }
}

void Client::say(const Wheel& wheel) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(CreateControl(builder,
                                 parts_->tick,
                                 wheel.throttle,
                                 wheel.brake,
                                 wheel.steer,
                                 wheel.hand_brake,
                                 wheel.reverse,
                                 wheel.lamps));
    try {
        parts_->channel.send(Kind::control, {builder.GetBufferPointer(), builder.GetSize()});
    } catch (const ChannelFault&) {
        // Then the run's last word is waiting: next() says it.
    }
}

}  // namespace reprise::remote

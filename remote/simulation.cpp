// Episodes at a server, from the client's side.
//   must      leave no server of its own behind, however this program ends
//   assumes   one episode at a time
//   goes      open once; for each episode reset, then hello and ticks as in any run (client.h)
//   keeps     the connection; each episode looks at it through a copy of the descriptor
#include "remote/simulation.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <numbers>
#include <sys/socket.h>

#include <fmt/format.h>

#include "process/companion.h"
#include "remote/connection.h"
#include "remote/descriptor.h"
#include "remote/frame_channel.h"
#include "remote/schema.h"
#include "world/check.h"

namespace reprise::remote {

namespace {

constexpr std::size_t largest_from_server = 256 << 20;  // [bytes] a town of a large city
constexpr double degrees = 180 / std::numbers::pi;
constexpr int no_such_program = 127;  // as shells have it
using Builder = flatbuffers::FlatBufferBuilder;

/// For the shell.
std::string quoted(const std::string& word) {
    std::string all = "'";
    for (const char letter : word)
        all += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return all + "'";
}

std::string program_of(const Simulation::Server& server) {
    if (!server.program.empty())
        return server.program;
    const char* named = std::getenv("REPRISE");
    return named == nullptr || *named == 0 ? "reprise" : named;
}

flatbuffers::Offset<Place> pack(Builder& builder, const TaskPlace& place) {
    if (const auto* on_lane = std::get_if<OnLane>(&place))
        return CreatePlace(
            builder, PlaceKind::lane, builder.CreateString(on_lane->lane), on_lane->s);
    if (const auto* point = std::get_if<AtSpawnPoint>(&place))
        return CreatePlace(builder, PlaceKind::spawn_point, 0, 0, point->index);
    return CreatePlace(builder, PlaceKind::drawn);
}

flatbuffers::Offset<TaskSensor> pack(Builder& builder, const TaskCamera& camera) {
    const world::SensorSpec& sensor = camera.sensor;
    std::vector<flatbuffers::Offset<TaskAttribute>> attributes;
    for (const world::AttributeValue& one : sensor.attributes)
        attributes.push_back(
            CreateTaskAttribute(builder, builder.CreateString(one.name), one.value));
    return CreateTaskSensor(builder,
                            builder.CreateString(sensor.name),
                            builder.CreateString(world::EnumNameSensorKind(sensor.kind)),
                            static_cast<std::uint32_t>(sensor.width),
                            static_cast<std::uint32_t>(sensor.height),
                            sensor.fov * degrees,
                            sensor.position.x(),
                            sensor.position.y(),
                            sensor.position.z(),
                            sensor.yaw * degrees,
                            sensor.pitch * degrees,
                            camera.every,
                            sensor.roll * degrees,
                            builder.CreateVector(attributes));
}

flatbuffers::Offset<Task> pack_task(Builder& builder, const EpisodePlan& plan) {
    std::vector<flatbuffers::Offset<TaskSensor>> rig;
    for (const TaskCamera& camera : plan.rig)
        rig.push_back(pack(builder, camera));
    const auto start = pack(builder, plan.start);
    const auto goal = plan.goal ? pack(builder, *plan.goal) : flatbuffers::Offset<Place>();
    return CreateTask(builder,
                      builder.CreateString(plan.town),
                      plan.cars,
                      builder.CreateString(plan.weather),
                      builder.CreateString(plan.model),
                      start,
                      goal,
                      builder.CreateVector(rig),
                      plan.walkers,
                      plan.walker_seed.has_value(),
                      plan.walker_seed.value_or(0),
                      plan.every);
}

Builder pack(const EpisodePlan& plan) {
    Builder builder;
    std::vector<flatbuffers::Offset<Setting>> settings;
    for (const auto& [key, value] : plan.settings)
        settings.push_back(
            CreateSetting(builder, builder.CreateString(key), builder.CreateString(value)));
    const bool is_task = plan.file.empty() && plan.source.empty();
    const auto task = is_task ? pack_task(builder, plan) : flatbuffers::Offset<Task>();
    const auto file = builder.CreateString(plan.file);
    const auto source = builder.CreateString(plan.source);
    const auto of_settings = builder.CreateVector(settings);
    const auto trace = builder.CreateString(plan.trace);
    builder.Finish(CreateReset(builder,
                               file,
                               source,
                               task,
                               0,
                               plan.seed.has_value(),
                               plan.seed.value_or(0),
                               plan.seconds,
                               of_settings,
                               trace));
    return builder;
}

}  // namespace

struct Simulation::Connection {
    explicit Connection(const Server& server)
        : channel(server.address.empty() ? start(server) : open_connection(server.address),
                  largest_from_server),
          polling(server.polling) {}

    /// A server of our own, for one client, at the other end of a socket pair.
    int start(const Server& server) {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            throw world::Error(std::string("no socket for a server: ") + std::strerror(errno));
        const Descriptor theirs(ends[1]);
        own.emplace(fmt::format("exec {} serve --socket fd:{} --folder {}",
                                quoted(program_of(server)),
                                theirs.number(),
                                quoted(server.folder)),
                    theirs.number(),
                    "REPRISE_SERVED=fd:%d");
        return ends[0];
    }

    void say(Kind kind, const Builder& builder) {
        try {
            channel.send(kind, {builder.GetBufferPointer(), builder.GetSize()});
        } catch (const ChannelFault& fault) {
            throw world::Error(std::string("the server ") + fault.what());
        }
    }

    /// The first words of both.
    void open(const std::string& token) {
        Builder builder;
        const auto schema = builder.CreateString(schema_digest());
        builder.Finish(CreateOpen(builder, wire_version, schema, builder.CreateString(token)));
        Frame answer;
        try {
            // A server that never was may be gone before we speak, or before it would.
            channel.send(Kind::open, {builder.GetBufferPointer(), builder.GetSize()});
            answer = channel.receive();
        } catch (const ChannelFault& fault) {
            const auto ended = own ? own->wait(1) : std::nullopt;
            throw world::Error(
                ended && ended->code == no_such_program
                    ? "no program 'reprise' in PATH: install it, or name it in the variable REPRISE"
                    : std::string("the server ") + fault.what());
        }
        if (answer.kind == Kind::fault) {
            const auto* text = answer.as<Fault>().text();
            throw world::Error(text == nullptr ? "the server refuses us" : text->str());
        }
        if (answer.kind == Kind::hello)
            throw world::Error("no server is there, but a run that waits for a driver");
        if (answer.kind != Kind::open || answer.as<Open>().version() != wire_version)
            throw world::Error(
                fmt::format("the server speaks another version of the wire than this program ({})",
                            wire_version));
    }

    std::optional<process::Companion> own;  // waited for once the channel is closed
    FrameChannel channel;
    double polling;  ///< [s] in episodes
};

Simulation::Simulation(const Server& server) : connection_(std::make_unique<Connection>(server)) {
    connection_->open(server.token);
}

Simulation::~Simulation() {
    Builder builder;
    builder.Finish(CreateGoodbye(builder, builder.CreateString("closed")));
    try {
        connection_->say(Kind::goodbye, builder);
    } catch (const world::Error&) {
        // It went first.
    }
    run_.reset();
}

std::optional<world::TickView> Simulation::look() {
    try {
        auto tick = run_->next();
        runs_ = tick.has_value();
        if (!tick)
            outcome_ = run_->outcome();
        return tick;
    } catch (const world::Error&) {
        runs_ = false;
        throw;
    }
}

std::optional<world::TickView> Simulation::reset(const EpisodePlan& plan) {
    runs_ = false;
    outcome_ = {};
    connection_->say(Kind::reset, pack(plan));
    const int copy = fcntl(connection_->channel.descriptor(), F_DUPFD_CLOEXEC, 0);
    if (copy < 0)
        throw world::Error(std::string("no descriptor is left: ") + std::strerror(errno));
    run_ = std::make_unique<Client>(FrameChannel(copy, largest_from_server), connection_->polling);
    return look();
}

std::optional<world::TickView> Simulation::step(const Client::Wheel& wheel) {
    if (!runs_)
        throw world::Error("no episode runs: reset() begins one");
    run_->say(wheel);
    return look();
}

const Client& Simulation::run() const {
    if (!run_)
        throw world::Error("there was no episode yet: reset() begins one");
    return *run_;
}

}  // namespace reprise::remote

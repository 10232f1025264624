#include "cli/external/serve_session.h"

#include <csignal>
#include <utility>

#include <fmt/format.h>

#include "cli/external/serve_drivers.h"
#include "cli/external/serve_episode.h"
#include "cli/external/serve_folder.h"
#include "cli/external/serve_stage.h"
#include "cli/external/serve_task.h"
#include "cli/fingerprint/this_build.h"
#include "cli/town/town_traffic.h"
#include "cli/town/towns.h"
#include "ground/mesh/build_ground.h"
#include "remote/schema.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/lanes/density.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

using remote::Kind;
constexpr double taking = 10;               // [s] for a client to take our word
constexpr double longest_episode = 86'400;  // [s] of simulated time: a day, as of a run

std::string text_of(const flatbuffers::String* text) {
    return text == nullptr ? "" : text->str();
}

/// As long for a wrong token as for a right one.
bool is_same(const std::string& said, const std::string& wanted) {
    unsigned different = said.size() == wanted.size() ? 0 : 1;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        different |= static_cast<unsigned char>(wanted[i]) ^
                     static_cast<unsigned char>(i < said.size() ? said[i] : 0);
    return different == 0;
}

void send_fault(remote::FrameChannel& client, const std::string& text) {
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(remote::CreateFault(
        builder, builder.CreateString(world::printable(text)), line_named_in(text)));
    client.send(Kind::fault, {builder.GetBufferPointer(), builder.GetSize()}, {taking});
}

scripting::Overrides overrides_of(const remote::Reset& reset) {
    scripting::Overrides overrides;
    if (reset.seeded())
        overrides.seed = reset.seed();
    if (const double limit = reset.seconds(); limit != 0) {
        if (!(limit > 0 && limit <= longest_episode))
            throw world::Error(
                fmt::format("seconds = {}: must be in (0, {}]", limit, longest_episode));
        overrides.duration = limit;
    }
    if (reset.settings() != nullptr)
        for (const remote::Setting* one : *reset.settings())
            overrides.parameters.emplace_back(text_of(one->key()), text_of(one->value()));
    return overrides;
}

}  // namespace

std::unique_ptr<ReadyTown> make_ready(const std::string& town, const std::string& folder) {
    auto ready = std::make_unique<ReadyTown>();
    refuse_links_to_towns(folder, town);
    towns::Network network = load_named_town(town, folder);
    ready->name = town;
    ready->recording.town = towns::read_town(network);
    ready->recording.episode.town = network.name;
    ready->recording.episode.town_digest = world::digest128(network.xml);
    ready->recording.network = std::move(network.xml);
    ready->ground =
        std::make_unique<const kernel::SolidGround>(ground::build_ground(ready->recording.town));
    return ready;
}

struct Session::Parts {
    void greet(const remote::Patience& patience, const std::function<std::string()>& why_not);
    std::optional<remote::Frame> begin(const remote::Frame& frame);
    void hang_up(const remote::ChannelFault& fault);
    world::EpisodeT episode_of(const remote::Reset& reset);
    void want_town(const std::string& town);
    Stage& stage_for(world::EpisodeT episode);

    ServeOptions options;
    std::string token;
    std::unique_ptr<ReadyTown> town;
    remote::FrameChannel client;
    const process::HeldSignals& signals;
    std::optional<Stage> stage;  ///< of town->recording
    bool stopped = false;
    bool left = false;  ///< the client has said goodbye
    bool is_greeted = false;
};

/// The client's first word, and ours. Throws ChannelFault when it shall not stay.
void Session::Parts::greet(const remote::Patience& patience,
                           const std::function<std::string()>& why_not) {
    const remote::Frame frame = client.receive(patience);
    std::string why;
    if (frame.kind != Kind::open)
        why = "a client begins with open";
    else if (const auto& open = frame.as<remote::Open>(); open.version() != remote::wire_version)
        why = fmt::format("the client speaks version {} of the wire, this server {}",
                          open.version(),
                          remote::wire_version);
    else if (!is_same(text_of(open.token()), token))
        why = token.empty() ? "this server wants no token"
                            : "wrong token: it is in the server's --token-file";
    else
        why = why_not();
    if (!why.empty()) {
        send_fault(client, why);
        throw remote::ChannelFault(why);
    }
    flatbuffers::FlatBufferBuilder builder;
    builder.Finish(remote::CreateOpen(
        builder, remote::wire_version, builder.CreateString(remote::schema_digest())));
    client.send(Kind::open, {builder.GetBufferPointer(), builder.GetSize()}, {taking});
    is_greeted = true;
}

/// The client has left, or was to leave; or what it said cannot be understood, which it is told:
/// behind that nothing else can be, either.
void Session::Parts::hang_up(const remote::ChannelFault& fault) {
    if (fault.why != remote::ChannelFault::Why::other || !is_greeted)
        return;
    try {
        send_fault(client, fmt::format("the client {}", fault.what()));
    } catch (const remote::ChannelFault&) {
        // Nobody hears it.
    }
}

void Session::Parts::want_town(const std::string& name) {
    if (town && (town->name == name || town->recording.town.name == name))
        return;
    stage.reset();
    town = make_ready(name, options.folder);
}

/// Makes its town ready as well.
world::EpisodeT Session::Parts::episode_of(const remote::Reset& reset) {
    const scripting::Overrides overrides = overrides_of(reset);
    const std::string file = text_of(reset.file());
    const std::string source = text_of(reset.source());
    if ((file.empty() ? 0 : 1) + (source.empty() ? 0 : 1) + (reset.task() == nullptr ? 0 : 1) != 1)
        throw world::Error("reset: expected a file, a source or a task");
    world::EpisodeT episode;
    if (reset.task() != nullptr) {
        want_town(text_of(reset.task()->town()));
        TaskScenario task = scenario_of(*reset.task(), town->recording.town);
        task.overrides.seed = overrides.seed;
        task.overrides.duration = overrides.duration;
        if (!overrides.parameters.empty())
            throw world::Error("reset: settings are for scenarios, a task has none");
        episode = scripting::episode_of_text("task.lua", task.source, task.overrides);
    } else if (!file.empty()) {
        episode = scripting::load_episode(file_in(options.folder, file, ".lua"), overrides);
        for (const world::FileT& one : episode.files)  // that it names
            file_in(options.folder, one.name, ".csv");
    } else {
        const std::string name = text_of(reset.name());
        episode = scripting::episode_of_text(
            name.empty() ? "scenario.lua" : world::printable(name.substr(0, 200)),
            source,
            overrides);
    }
    want_town(episode.town);
    return episode;
}

/// With a kernel that is ready; the last one's, when it starts from the same.
Stage& Session::Parts::stage_for(world::EpisodeT episode) {
    world::EpisodeT& ours = town->recording.episode;
    episode.town_path = episode.town;
    episode.town = town->recording.town.name;
    world::settle_cars(episode, town->recording.town);
    episode.town_digest = ours.town_digest;
    episode.fingerprint = this_build();
    if (!stage || ours != episode) {
        stage.reset();
        if (ours.cars != episode.cars || ours.town != episode.town)
            tell_if_crowded(episode, town->recording.town);
        ours = std::move(episode);
        const auto memory = static_cast<std::uint64_t>(options.memory_gb * 1e9);
        stage.emplace(Stage::Set{
            town->recording, *town->ground, client, signals, options.folder, {.memory = memory}});
    }
    return *stage;
}

/// One episode, or a word about why there is none. Returns what the client said meanwhile in place
/// of a control.
std::optional<remote::Frame> Session::Parts::begin(const remote::Frame& frame) {
    try {
        if (frame.kind != Kind::reset)
            throw world::Error("between episodes a client says reset or goodbye");
        const auto& reset = frame.as<remote::Reset>();
        if (const std::string trace = text_of(reset.trace()); !trace.empty())
            file_in(options.folder, trace, ".mcap");
        drivers_of(reset, client);  // throws for what cannot be
        Stage::End end = stage_for(episode_of(reset)).play(frame);
        stopped = stopped || end.stopped;
        left = end.left;
        return std::move(end.next);
    } catch (const remote::ChannelFault&) {
        throw;
    } catch (const std::exception& error) {
        stage.reset();
        send_fault(client, as_named_in(options.folder, error.what()));
        return std::nullopt;
    }
}

Session::Session(const ServeOptions& options,
                 std::string token,
                 std::unique_ptr<ReadyTown> town,
                 remote::FrameChannel client,
                 const process::HeldSignals& signals)
    : parts_(new Parts{options,
                       std::move(token),
                       std::move(town),
                       std::move(client),
                       signals,
                       std::nullopt,
                       false,
                       false,
                       false}) {}

Session::~Session() = default;

void Session::run(std::optional<double> greeting, const std::function<std::string()>& why_not) {
    Parts& parts = *parts_;
    const auto is_to_end = [&] {
        const int signal = parts.signals.take();
        return parts.stopped = parts.stopped || (signal != 0 && signal != SIGCHLD);
    };
    try {
        parts.greet({greeting, is_to_end}, why_not);
        std::optional<remote::Frame> word;
        while (!is_to_end()) {
            if (!word)
                word = parts.client.receive({std::nullopt, is_to_end});
            if (word->kind == Kind::goodbye)
                break;
            word = parts.begin(*word);
            if (parts.left)
                break;
        }
    } catch (const remote::ChannelFault& fault) {
        parts.hang_up(fault);
    }
}

}  // namespace reprise::cli

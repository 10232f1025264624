#include "exchange/foxglove.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "exchange/base64.h"
#include "exchange/foxglove_scene.h"
#include "exchange/geo_origin.h"
#include "foxglove_schemas.h"
#include "replay/trace_file.h"
#include "world/check.h"
#include "world/story/crashes.h"
#include "world/story/wording.h"

namespace reprise::exchange {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Foxglove's LogLevel.
enum LogLevel { debug = 1, info = 2, warning = 3, error = 4 };

LogLevel level_of(world::EventKind kind) {
    switch (kind) {
        case world::EventKind::spawned:
        case world::EventKind::despawned:
            return LogLevel::debug;
        case world::EventKind::collision:
        case world::EventKind::collision_ended:
        case world::EventKind::blocked:
        case world::EventKind::not_evaluated:
            return LogLevel::warning;
        case world::EventKind::check_failed:
            return LogLevel::error;
        default:
            return LogLevel::info;
    }
}

std::string text_of(const world::Event& event, const world::ActorNames& names) {
    const std::string said = world::to_line(event);
    switch (event.kind()) {
        case world::EventKind::printed:
            return said;
        case world::EventKind::collision:
            return fmt::format("collision of {} with {} begins",
                               names.name_of(event.actor()),
                               names.name_of(event.other()));
        case world::EventKind::collision_ended:
            return fmt::format("collision of {} with {} ended: {} N s, in contact for {:.2f} s",
                               names.name_of(event.actor()),
                               names.name_of(event.other()),
                               world::with_thousands(event.value()),
                               event.duration());
        default:
            return fmt::format("{}: {}{}",
                               world::EnumNameEventKind(event.kind()),
                               event.actor() == 0 ? "" : std::to_string(event.actor()) + " ",
                               said);
    }
}

/// Pictures of one camera, by tick.
struct Camera {
    std::string topic;
    std::map<std::uint64_t, fs::path> pictures;
};

Camera camera_in(const fs::path& folder, const std::string& topic) {
    Camera camera{topic, {}};
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string stem = entry.path().stem().string();
        std::uint64_t tick = 0;
        const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), tick);
        if (entry.path().extension() == ".png" && error == std::errc() &&
            end == stem.data() + stem.size())
            camera.pictures[tick] = entry.path();
    }
    return camera;
}

/// The folder itself, or its sub-folders: rgb, depth, semantic.
std::vector<Camera> cameras_in(const fs::path& folder) {
    std::vector<Camera> cameras;
    if (folder.empty())
        return cameras;
    if (!fs::is_directory(folder))
        throw world::Error(folder.string() + ": no such folder of pictures");
    std::vector<Camera> found{camera_in(folder, "/camera")};
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_directory())
            found.push_back(camera_in(entry.path(), "/camera/" + entry.path().filename().string()));
    std::sort(found.begin(), found.end(), [](const Camera& one, const Camera& other) {
        return one.topic < other.topic;
    });
    for (Camera& camera : found)
        if (!camera.pictures.empty())
            cameras.push_back(std::move(camera));
    if (cameras.empty())
        throw world::Error(folder.string() +
                           ": expected pictures named by tick, such as 000120.png, found none");
    return cameras;
}

std::string read_bytes(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw world::Error(path.string() + ": cannot be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

replay::TraceFile::Channel channel(const std::string& topic, const char* name, const char* schema) {
    return {topic, std::string("foxglove.") + name, "jsonschema", schema, "json"};
}

constexpr std::size_t chunk_bytes = std::size_t{4} << 20;

/// The file as it grows.
class Export {
  public:
    Export(replay::TraceReader& trace, const FoxgloveOptions& options, const fs::path& out)
        : trace_(trace),
          options_(options),
          cameras_(cameras_in(options.images)),
          origin_(GeoOrigin::of(trace.recording().network)),
          file_(out, channels()) {
        result_.located = origin_.has_value();
    }

    FoxgloveExport run() {
        try {
            write_all();
            file_.chunk(pending_);
            file_.finish();
        } catch (...) {
            file_.discard();
            throw;
        }
        return result_;
    }

  private:
    enum : std::uint16_t { town = 1, actors, tf, log, location, first_camera };

    std::vector<replay::TraceFile::Channel> channels() const {
        std::vector<replay::TraceFile::Channel> list{
            channel("/town", "SceneUpdate", foxglove_schemas::SceneUpdate),
            channel("/actors", "SceneUpdate", foxglove_schemas::SceneUpdate),
            channel("/tf", "FrameTransforms", foxglove_schemas::FrameTransforms),
            channel("/log", "Log", foxglove_schemas::Log),
            channel("/location", "LocationFix", foxglove_schemas::LocationFix)};
        for (const Camera& camera : cameras_)
            list.push_back(
                channel(camera.topic, "CompressedImage", foxglove_schemas::CompressedImage));
        return list;
    }

    void write_all() {
        trace_.tick(options_.first);  // says at once when its level leaves out what scenes need
        const json start = timestamp(options_.first, step_ns());
        put(town, options_.first, town_scene(trace_.recording().town, start));
        if (const auto slice = trace_.slice())
            for (const auto& [actor, spawn] : slice->spawns)
                names_[actor] = spawn.command.text;
        for (std::uint64_t index = trace_.first(); index <= options_.last; ++index) {
            const bool seen =
                index >= options_.first && (index - options_.first) % options_.every == 0;
            const replay::RecordedTick recorded =
                seen ? trace_.tick(index) : trace_.recorded(index);
            const world::TickView& tick = recorded.view;
            learn_names(tick);
            if (index < options_.first)
                continue;
            const json time = timestamp(index, step_ns());
            if (seen)
                write_scene(tick, time);
            write_log(tick, time);
            write_pictures(index, time);
            if (pending_.records.size() >= chunk_bytes) {
                file_.chunk(pending_);
                pending_.clear();
            }
        }
    }

    /// The scenario's actors are known by the names it spawned them with.
    void learn_names(const world::TickView& tick) {
        all_names_.hear(tick);
        for (const world::Event* event : *tick.tick->events())
            if (event->kind() == world::EventKind::spawned && event->text() != nullptr &&
                event->actor() < world::first_background_id)
                names_[event->actor()] = event->text()->str();
    }

    void write_scene(const world::TickView& tick, const json& time) {
        put(actors, tick.index(), actors_scene(tick, trace_.recording().town, names_, time));
        put(tf, tick.index(), transforms(tick, names_, time));
        if (!origin_ || tick.vehicles().empty())
            return;
        const world::VehicleState& first = tick.vehicles().front();
        const Geodetic at = origin_->at(first.position());
        constexpr int unknown = 0;
        put(location,
            tick.index(),
            {{"timestamp", time},
             {"frame_id", frame_name(first.id(), names_)},
             {"latitude", at.latitude_deg},
             {"longitude", at.longitude_deg},
             {"altitude", first.position().z()},
             {"position_covariance", std::vector<double>(9, 0.0)},
             {"position_covariance_type", unknown}});
    }

    void write_log(const world::TickView& tick, const json& time) {
        for (const world::Event* event : *tick.tick->events()) {
            // Background cars come and go all the time.
            if (event->actor() >= world::first_background_id &&
                event->kind() != world::EventKind::collision &&
                event->kind() != world::EventKind::collision_ended)
                continue;
            put(log,
                tick.index(),
                {{"timestamp", time},
                 {"level", static_cast<int>(level_of(event->kind()))},
                 {"message", text_of(*event, all_names_)},
                 {"name", "scenario"},
                 {"file", trace_.episode().scenario_path},
                 {"line", event->line()}});
        }
    }

    void write_pictures(std::uint64_t index, const json& time) {
        for (std::size_t i = 0; i < cameras_.size(); ++i) {
            const auto picture = cameras_[i].pictures.find(index);
            if (picture == cameras_[i].pictures.end())
                continue;
            put(static_cast<std::uint16_t>(first_camera + i),
                index,
                {{"timestamp", time},
                 {"frame_id", "camera"},
                 {"data", base64(read_bytes(picture->second))},
                 {"format", "png"}});
            ++result_.images;
        }
    }

    void put(std::uint16_t to, std::uint64_t tick, const json& message) {
        const std::string text = message.dump(-1, ' ', false, json::error_handler_t::replace);
        pending_.add(to,
                     tick,
                     tick * step_ns(),
                     {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
        ++result_.messages;
    }

    std::uint64_t step_ns() const { return trace_.episode().step_ns; }

    replay::TraceReader& trace_;
    FoxgloveOptions options_;
    std::vector<Camera> cameras_;
    std::optional<GeoOrigin> origin_;
    replay::TraceFile file_;
    replay::PendingChunk pending_;
    Names names_;                  ///< of the scenario's
    world::ActorNames all_names_;  ///< of the demand's, too
    FoxgloveExport result_;
};

}  // namespace

FoxgloveExport export_foxglove(replay::TraceReader& trace,
                               const FoxgloveOptions& options,
                               const fs::path& out) {
    return Export(trace, options, out).run();
}

}  // namespace reprise::exchange

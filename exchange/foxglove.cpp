#include "exchange/foxglove.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "exchange/base64.h"
#include "exchange/foxglove_scene.h"
#include "exchange/geo_origin.h"
#include "exchange/point_cloud.h"
#include "exchange/rendered_folder.h"
#include "foxglove_schemas.h"
#include "replay/table/actor_search.h"
#include "replay/trace_file.h"
#include "world/check.h"
#include "world/external/mounting.h"
#include "world/models/actors.h"
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
          rendered_(options.images.empty() ? RenderedFolder() : rendered_folder(options.images)),
          origin_(GeoOrigin::of(trace.recording().network)),
          file_(out, channels(), files::Unfinished::remove, "the export") {
        result_.located = origin_.has_value();
        for (const RenderedSensor& sensor : rendered_.points)
            carriers_.push_back(carrier_of(sensor));
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
        for (const RenderedSensor& camera : rendered_.cameras)
            list.push_back(
                channel(camera.topic, "CompressedImage", foxglove_schemas::CompressedImage));
        for (const RenderedSensor& sensor : rendered_.points)
            list.push_back(channel(sensor.topic, "PointCloud", foxglove_schemas::PointCloud));
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
                seen || has_points(index) ? trace_.tick(index) : trace_.recorded(index);
            const world::TickView& tick = recorded.view;
            learn_names(tick);
            if (index < options_.first)
                continue;
            const json time = timestamp(index, step_ns());
            if (seen)
                write_scene(tick, time);
            write_log(tick, time);
            write_pictures(index, time);
            write_points(tick, time);
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
        for (std::size_t i = 0; i < rendered_.cameras.size(); ++i) {
            const auto picture = rendered_.cameras[i].files.find(index);
            if (picture == rendered_.cameras[i].files.end())
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

    bool has_points(std::uint64_t index) const {
        return std::any_of(
            rendered_.points.begin(), rendered_.points.end(), [&](const RenderedSensor& sensor) {
                return sensor.files.contains(index);
            });
    }

    void write_points(const world::TickView& tick, const json& time) {
        for (std::size_t i = 0; i < rendered_.points.size(); ++i) {
            const RenderedSensor& sensor = rendered_.points[i];
            const auto file = sensor.files.find(tick.index());
            if (file == sensor.files.end())
                continue;
            const auto pose_world_mount = mount_pose(tick, carriers_[i]);
            if (!pose_world_mount)
                continue;
            put(static_cast<std::uint16_t>(first_camera + rendered_.cameras.size() + i),
                tick.index(),
                point_cloud(read_point_cloud(file->second),
                            *pose_world_mount * world::pose_in_mount(sensor.place),
                            time));
            ++result_.clouds;
        }
    }

    /// Nobody: the first vehicle of each tick. 0: the world.
    std::optional<std::uint32_t> carrier_of(const RenderedSensor& sensor) const {
        if (sensor.mounted_on == "world")
            return 0;
        if (sensor.mounted_on == "the first vehicle")
            return std::nullopt;
        return replay::find_actor(trace_, sensor.mounted_on);
    }

    static std::optional<Eigen::Isometry3d> mount_pose(const world::TickView& tick,
                                                       std::optional<std::uint32_t> carrier) {
        if (!carrier && !tick.vehicles().empty())
            carrier = tick.vehicles().front().id();
        if (!carrier)
            return std::nullopt;
        return *carrier == 0 ? Eigen::Isometry3d::Identity() : world::find_pose(tick, *carrier);
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
    RenderedFolder rendered_;
    std::vector<std::optional<std::uint32_t>> carriers_;  ///< of its points
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

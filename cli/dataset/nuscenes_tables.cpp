// What it must do: tables that nuscenes-devkit 1.2 opens as v1.0-mini.
// What it assumes: all files of the data set are there.
// How it goes: what sensors see is read once; under each weather points are counted, and tables
//   written: what never changes, sensors, logs with maps, scenes with samples and their data,
//   instances with annotations. Rows that follow each other name each other.
// What it keeps: nothing.
#include "cli/dataset/nuscenes_tables.h"

#include <algorithm>
#include <chrono>

#include "cli/dataset/nuscenes_annotations.h"
#include "cli/dataset/nuscenes_content.h"
#include "cli/dataset/nuscenes_names.h"
#include "files/output_file.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json rows_of(const Eigen::Matrix3d& matrix) {
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row)
        rows.push_back({matrix(row, 0), matrix(row, 1), matrix(row, 2)});
    return rows;
}

Json named(std::span<const NuscenesName> names, const char* table, const char* key) {
    Json rows = Json::array();
    for (const NuscenesName& one : names)
        rows.push_back({{"token", nuscenes_token(table, one.name)},
                        {key, one.name},
                        {"description", one.description}});
    return rows;
}

void add_fixed(NuscenesTables& tables) {
    tables["category"] = named(nuscenes_categories(), "category", "name");
    for (std::size_t i = 0; i < tables["category"].size(); ++i)
        tables["category"][i]["index"] = i + 1;
    tables["attribute"] = named(nuscenes_attributes(), "attribute", "name");
    tables["visibility"] = named(nuscenes_visibilities(), "visibility", "level");
    for (std::size_t i = 0; i < tables["visibility"].size(); ++i)
        tables["visibility"][i]["token"] = std::to_string(i + 1);
}

std::string date_of(std::size_t trace) {
    const std::chrono::year_month_day day(std::chrono::sys_days(std::chrono::days(trace + 1)));
    return fmt::format("{:04}-{:02}-{:02}",
                       static_cast<int>(day.year()),
                       static_cast<unsigned>(day.month()),
                       static_cast<unsigned>(day.day()));
}

void add_logs(const NuscenesContent& content, NuscenesTables& tables) {
    for (std::size_t i = 0; i < content.logs.size(); ++i)
        tables["log"].push_back({{"token", content.log(i)},
                                 {"logfile", content.logs[i].chain},
                                 {"vehicle", "reprise"},
                                 {"date_captured", date_of(i)},
                                 {"location", content.logs[i].town}});
    for (const NuscenesMap& map : content.maps) {
        Json logs = Json::array();
        for (const std::size_t trace : map.traces)
            logs.push_back(content.log(trace));
        tables["map"].push_back({{"token", nuscenes_token("map", map.town)},
                                 {"log_tokens", logs},
                                 {"category", "semantic_prior"},
                                 {"filename", "maps/" + map.town + ".png"}});
    }
}

void add_sensors(const NuscenesContent& content, NuscenesTables& tables) {
    for (const NuscenesChannel& channel : content.channels) {
        const std::string sensor = nuscenes_token("sensor", channel.name);
        tables["sensor"].push_back(
            {{"token", sensor}, {"channel", channel.name}, {"modality", channel.modality}});
        for (std::size_t trace = 0; trace < content.logs.size(); ++trace)
            tables["calibrated_sensor"].push_back(
                {{"token", content.calibration(trace, channel)},
                 {"sensor_token", sensor},
                 {"translation", json_of(Eigen::Vector3d(channel.pose_ego.translation()))},
                 {"rotation", json_of(Eigen::Matrix3d(channel.pose_ego.linear()))},
                 {"camera_intrinsic",
                  channel.camera ? rows_of(channel.intrinsic) : Json::array()}});
    }
}

void add_scenes(const NuscenesContent& content,
                const std::string& weather,
                NuscenesTables& tables) {
    for (std::size_t number = 0; number < content.scenes.size(); ++number) {
        const std::size_t id = content.scenes[number];
        const std::size_t end =
            number + 1 < content.scenes.size() ? content.scenes[number + 1] : content.frames.size();
        const NuscenesFrame& frame = content.frames[id];
        const NuscenesLog& log = content.logs[frame.trace];
        const std::string name = fmt::format("scene-{:04}", number + 1);
        tables["scene"].push_back({{"token", content.scene(number)},
                                   {"log_token", content.log(frame.trace)},
                                   {"nbr_samples", end - id},
                                   {"first_sample_token", content.sample(id)},
                                   {"last_sample_token", content.sample(end - 1)},
                                   {"name", name},
                                   {"description",
                                    fmt::format("{}, seed {}, {}",
                                                log.scenario,
                                                log.seed,
                                                weather == "recorded" ? log.weather : weather)}});
        tables["splits"]["reprise_" + frame.split].push_back(name);
    }
}

void add_samples(const NuscenesContent& content, NuscenesTables& tables) {
    const auto neighbour = [&](std::size_t id, bool next) {
        const auto other = content.beside(id, next);
        return other ? content.sample(*other) : "";
    };
    for (std::size_t id = 0; id < content.frames.size(); ++id)
        tables["sample"].push_back({{"token", content.sample(id)},
                                    {"timestamp", content.time(id)},
                                    {"prev", neighbour(id, false)},
                                    {"next", neighbour(id, true)},
                                    {"scene_token", content.scene(content.scene_of[id])}});
}

/// Of samples and sweeps; a sweep is of the sample that comes next.
void add_data(const NuscenesContent& content, const std::string& weather, NuscenesTables& tables) {
    const DatasetLayout& layout = content.layout;
    const fs::path root = layout.root() / DatasetLayout::folder_of(weather);
    for (std::size_t number = 0; number < content.moments.size(); ++number) {
        const Moment& moment = content.moments[number];
        const std::size_t id = moment.id;
        const Eigen::Isometry3d& pose = content.pose_world_ego(moment);
        for (const NuscenesChannel& channel : content.channels) {
            const auto neighbour = [&](bool next) {
                const auto other = content.beside_moment(number, next);
                return other ? content.data(*other, channel) : "";
            };
            const std::string own = content.data(moment, channel);
            const fs::path path = channel.camera ? layout.picture(channel.number, weather, moment)
                                                 : layout.points(channel.number, weather, moment);
            const world::SensorSpec* camera =
                channel.camera ? &layout.cameras()[channel.number] : nullptr;
            tables["ego_pose"].push_back({{"token", own},
                                          {"timestamp", content.time(moment)},
                                          {"rotation", json_of(Eigen::Matrix3d(pose.linear()))},
                                          {"translation", json_of(content.place(id, pose))}});
            tables["sample_data"].push_back(
                {{"token", own},
                 {"sample_token", content.sample(id)},
                 {"ego_pose_token", own},
                 {"calibrated_sensor_token",
                  content.calibration(content.frames[id].trace, channel)},
                 {"timestamp", content.time(moment)},
                 {"fileformat", camera != nullptr ? "png" : "pcd"},
                 {"is_key_frame", !moment.is_sweep()},
                 {"height", camera != nullptr ? camera->height : 0},
                 {"width", camera != nullptr ? camera->width : 0},
                 {"filename", path.lexically_relative(root).string()},
                 {"prev", neighbour(false)},
                 {"next", neighbour(true)}});
        }
    }
}

}  // namespace

void write_nuscenes(const DatasetLayout& layout,
                    const std::list<DatasetSource>& sources,
                    const std::vector<std::string>& weathers,
                    const std::vector<DatasetFrame>& frames) {
    const NuscenesContent content(layout, sources, frames);
    for (const NuscenesMap& map : content.maps) {
        auto source = sources.begin();
        std::advance(source, static_cast<std::ptrdiff_t>(map.traces.front()));
        write_nuscenes_mask(
            map, source->trace().recording().town, layout.maps() / (map.town + ".png"));
    }
    for (const std::string& weather : weathers) {
        NuscenesTables tables;
        add_fixed(tables);
        add_logs(content, tables);
        add_sensors(content, tables);
        add_scenes(content, weather, tables);
        add_samples(content, tables);
        add_data(content, weather, tables);
        add_annotations(content, weather, tables);
        for (const auto& [name, rows] : tables)
            files::write_file(
                layout.tables(weather) / (name + ".json"), "the table", rows.dump(0) + "\n");
    }
}

}  // namespace reprise::cli

#include "exchange/rendered_folder.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/json_text.h"
#include "world/check.h"
#include "world/external/sensor.h"
#include "world/units.h"

namespace reprise::exchange {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::array<const char*, 1> of_pictures{".png"};
constexpr std::array<const char*, 3> of_points{".ply", ".pcd", ".bin"};

template <std::size_t count>
RenderedSensor sensor_in(const fs::path& folder,
                         const std::string& topic,
                         const std::array<const char*, count>& endings) {
    RenderedSensor sensor;
    sensor.topic = topic;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string stem = entry.path().stem().string();
        std::uint64_t tick = 0;
        const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), tick);
        if (std::find(endings.begin(), endings.end(), entry.path().extension()) != endings.end() &&
            error == std::errc() && end == stem.data() + stem.size())
            sensor.files[tick] = entry.path();
    }
    return sensor;
}

/// The sensors of a manifest; none where there is no manifest.
json sensors_of(const fs::path& folder) {
    const json manifest = json::parse(files::json_text(folder / "manifest.json"), nullptr, false);
    if (!manifest.is_object() || !manifest.contains("sensors") || !manifest["sensors"].is_array())
        return json::array();
    return manifest["sensors"];
}

/// Its points are files named by tick.
bool makes_points(const json& sensor) {
    const auto kind = world::find_sensor_kind(sensor.at("type").get<std::string>());
    return kind && world::is_ranging(*kind) && *kind != world::SensorKind::obstacle;
}

/// Says of points where they were measured. `named`: the sensor's folder; "": it is the only one
/// that makes points, beside whatever cameras.
void place(RenderedSensor& sensor, const fs::path& folder, const std::string& named) {
    const json sensors = sensors_of(folder);
    try {
        const bool alone = std::count_if(sensors.begin(), sensors.end(), makes_points) == 1;
        for (const json& one : sensors) {
            if (one.at("name") != named && !(named.empty() && alone && makes_points(one)))
                continue;
            const json& at = one.at("position");
            sensor.place.position = {
                at.at(0).get<double>(), at.at(1).get<double>(), at.at(2).get<double>()};
            sensor.place.roll = one.at("roll_deg").get<double>() * world::degree;
            sensor.place.pitch = one.at("pitch_deg").get<double>() * world::degree;
            sensor.place.yaw = one.at("yaw_deg").get<double>() * world::degree;
            sensor.mounted_on = one.at("mounted_on").get<std::string>();
            return;
        }
    } catch (const json::exception&) {
        // As if it said nothing.
    }
    throw world::Error(fmt::format("{}: manifest.json does not say where {} was: render it again",
                                   folder.string(),
                                   named.empty() ? "what measured its points" : named));
}

void keep_if_any(std::vector<RenderedSensor>& list, RenderedSensor sensor) {
    if (!sensor.files.empty())
        list.push_back(std::move(sensor));
}

}  // namespace

RenderedFolder rendered_folder(const fs::path& folder) {
    if (!fs::is_directory(folder))
        throw world::Error(folder.string() + ": no such folder of pictures");
    RenderedFolder found;
    const auto look_into = [&](const fs::path& path, const std::string& named) {
        const std::string below = named.empty() ? "" : "/" + named;
        keep_if_any(found.cameras, sensor_in(path, "/camera" + below, of_pictures));
        RenderedSensor points = sensor_in(path, "/points" + below, of_points);
        if (!points.files.empty())
            place(points, folder, named);
        keep_if_any(found.points, std::move(points));
    };
    look_into(folder, "");
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_directory())
            look_into(entry.path(), entry.path().filename().string());
    for (std::vector<RenderedSensor>* list : {&found.cameras, &found.points})
        std::sort(
            list->begin(), list->end(), [](const RenderedSensor& one, const RenderedSensor& other) {
                return one.topic < other.topic;
            });
    if (found.cameras.empty() && found.points.empty())
        throw world::Error(folder.string() +
                           ": expected pictures named by tick, such as 000120.png, or points, "
                           "such as 000120.ply, found none");
    return found;
}

}  // namespace reprise::exchange

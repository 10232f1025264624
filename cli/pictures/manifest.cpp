#include "cli/pictures/manifest.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/pictures/file_list.h"
#include "files/output_file.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/fingerprint.h"
#include "world/units.h"
#include "world/weather/weather_field.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// Of numbers with several names the first.
Json numbers_of(const world::Weather& weather) {
    Json json;
    std::vector<decltype(world::WeatherField::get)> seen;
    for (const world::WeatherField& field : world::weather_fields()) {
        if (std::find(seen.begin(), seen.end(), field.get) != seen.end())
            continue;
        seen.push_back(field.get);
        json[field.key] = field.said(weather);
    }
    return json;
}

Json weather_of(const RenderOptions& options) {
    const ChosenWeather chosen(options.weather, 1);
    if (!chosen.changes().empty())
        return "as recorded, but " + chosen.changes();
    if (!chosen.course())
        return "as recorded";
    Json stops = Json::array();
    for (const world::WeatherStop& stop : chosen.course()->stops())
        stops.push_back({{"at", stop.at}, {"numbers", numbers_of(stop.said.weather)}});
    return {{"said", chosen.course()->name()}, {"stops", stops}};
}

}  // namespace

fs::path manifest_of(const fs::path& output) {
    return film_ending(output).empty() ? output / "manifest.json"
                                       : fs::path(output.string() + ".manifest.json");
}

std::string sensor_text(const world::SensorSpec& sensor) {
    Json json{{"name", sensor.name}, {"type", world::EnumNameSensorKind(sensor.kind)}};
    if (world::is_camera(sensor.kind)) {
        json["size"] = {sensor.width, sensor.height};
        json["fov_deg"] = sensor.fov / world::degree;
    }
    json["position"] = {sensor.position.x(), sensor.position.y(), sensor.position.z()};
    json["roll_deg"] = sensor.roll / world::degree;
    json["pitch_deg"] = sensor.pitch / world::degree;
    json["yaw_deg"] = sensor.yaw / world::degree;
    for (const world::AttributeValue& one : sensor.attributes)
        json["attributes"][one.name] = one.value;
    return json.dump();
}

std::string chain_text(replay::TraceReader& trace) {
    return world::to_hex(trace.chain(trace.last()));
}

void write_manifest(const RenderOptions& options,
                    replay::TraceReader& trace,
                    const Ticks& ticks,
                    const std::vector<MountedSensor>& sensors,
                    const WrittenFiles& files) {
    const fs::path manifest = manifest_of(options.output);
    Json json;
    json["manifest"] = manifest_version;
    for (const auto& [key, value] : world::build_fingerprint())
        json["program"][key] = value;
    json["trace"] = {{"path", options.trace},
                     {"ticks", {trace.first(), trace.last()}},
                     {"chain", chain_text(trace)}};
    json["ticks"] = {{"from", ticks.from}, {"to", ticks.to}, {"every", ticks.every}};
    json["weather"] = weather_of(options);
    for (const MountedSensor& one : sensors) {
        Json& said = json["sensors"].emplace_back(Json::parse(sensor_text(one.sensor)));
        said["mounted_on"] = one.mounted_on;
    }
    json["options"] = Json::object();
    for (const auto& [name, value] : options.said)
        json["options"][name] = value;
    if (!options.rig.empty())
        json["rig"] = Json::parse(std::ifstream(options.rig, std::ios::binary));
    json["files"] = file_list(files.all(), manifest.parent_path());
    files::write_file(manifest, "the manifest", json.dump(1) + "\n");
}

}  // namespace reprise::cli

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/options/render_options.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/chosen_weather.h"
#include "cli/pictures/written_files.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// Where it lies: in the folder that it is about; beside a film, run.mp4.manifest.json.
std::filesystem::path manifest_of(const std::filesystem::path& output);

inline constexpr int manifest_version = 1;

/// A sensor and whose frame its place is in, for people: "ego", "the first vehicle", "world".
struct MountedSensor {
    const world::SensorSpec& sensor;
    std::string mounted_on;
};

/// Writes what a folder's files, or a film, were made from, and what they are: trace, ticks,
/// weather, sensors, options, the program, and XXH3 of each file. Depends on nothing else: neither
/// on the folder's name, nor on threads.
void write_manifest(const RenderOptions& options,
                    replay::TraceReader& trace,
                    const Ticks& ticks,
                    const std::vector<MountedSensor>& sensors,
                    const WrittenFiles& files);

/// Of a trace, or of a part of it: the chain of digests at its end says all that is before.
std::string chain_text(replay::TraceReader& trace);

/// A sensor as manifests say what it is: JSON.
std::string sensor_text(const world::SensorSpec& sensor);

}  // namespace reprise::cli

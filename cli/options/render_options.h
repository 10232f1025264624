#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "world/external/sensor.h"

namespace CLI {
class App;
}

namespace reprise::cli {

struct RenderOptions {
    std::string trace;
    std::string output;                             ///< a folder, or a film by its ending
    std::string weather;                            ///< empty: as recorded
    std::vector<std::string> cameras;               ///< kinds: rgb, depth, ...
    std::vector<std::string> measured;              ///< kinds that are no cameras
    std::vector<world::AttributeValue> attributes;  ///< of these and of cameras
    std::string points = "ply";                     ///< how points are written
    std::string readings = "csv";                   ///< and tables
    bool recorded_rig = true;  ///< where there is one: no option says other cameras
    int width = 800;
    int height = 600;
    std::optional<double> fov_deg;
    std::string ticks;  ///< A..B; empty: all
    std::string from;   ///< as it was said before --ticks: tick or time; empty: the first
    std::string to;     ///< likewise; empty: the last
    std::string every;  ///< empty: as the rig does; without one 1s, of a film each tick
    std::string actor;  ///< its name or its id; empty: the first physics vehicle
    std::vector<double> mount{1.0, 0.0, 1.4};
    double pitch_deg = 0;
    double yaw_deg = 0;
    std::string preset;              ///< chase, top, driver, orbit; empty: mount, pitch and yaw
    std::optional<double> distance;  ///< [m] of a preset's camera; none: as the preset has it
    bool heading_up = false;         ///< of the preset top
    bool overlay = false;
    bool no_view = false;  ///< no versions for people beside depths and classes
    std::string rig;       ///< a file of sensors; empty: as the other options say
    std::string depth_coding = "cm";
    std::string classes = "carla";
    std::string events = "npy";  ///< how those of dvs are written
    bool npy = false;            ///< floats as arrays of numpy
    bool exr = false;            ///< floats as EXR
    bool own_car = false;        ///< who carries a camera is in its pictures
    bool boxes = false;          ///< of all that is seen, for each picture
    bool calibration = false;    ///< of each camera, beside its pictures
    std::string compare;         ///< weathers side by side in a film
    std::string check;           ///< a manifest: make all of it again, and compare
    bool quiet = false;          ///< says nothing of what it made
    /// As they were said, without those of the trace, the output, the rig and threads.
    std::vector<std::pair<std::string, std::string>> said;
    int threads = 0;  ///< 0: one a core
    bool portable = false;
};

/// Options of `render` that are read once all words are there.
struct RenderWords {
    std::string size = "800x600";
    std::string mount;
    std::string threads;
    std::vector<std::string> attributes;
    std::string up = "north";
};

/// Adds `render`.
void add_render(CLI::App& app, RenderOptions& render, RenderWords& words);

/// What a film's name ends in, with the dot: .mp4, .mkv, .webm, .avi. Empty for a folder.
std::string film_ending(const std::string& output);

/// After parsing. Throws CLI::ValidationError.
void finish_render(const CLI::App& app, const RenderWords& words, RenderOptions& render);

}  // namespace reprise::cli

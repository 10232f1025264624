#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace reprise::cli {

struct RenderOptions {
    std::string trace;
    std::string directory;
    std::string weather;               ///< empty: as recorded
    std::vector<std::string> cameras;  ///< rgb, depth, semantic
    bool recorded_rig = true;          ///< where there is one: no option says other cameras
    int width = 800;
    int height = 600;
    double fov_deg = 90;
    std::string from;         ///< tick, or seconds with an s behind; empty: the first
    std::string to;           ///< likewise; empty: the last
    std::string every;        ///< empty: as the rig does; without one 1s
    std::uint32_t actor = 0;  ///< 0: the first physics vehicle
    std::vector<double> mount{1.0, 0.0, 1.4};
    double pitch_deg = 0;
    double yaw_deg = 0;
    int threads = 0;  ///< 0: one a core
    bool portable = false;
};

/// Options of `render` that are read once all words are there.
struct RenderWords {
    std::string size = "800x600";
    std::string mount;
    std::string threads;
};

/// Adds `render`.
void add_render(CLI::App& app, RenderOptions& render, RenderWords& words);

/// After parsing. Throws CLI::ValidationError.
void finish_render(const CLI::App& app, const RenderWords& words, RenderOptions& render);

}  // namespace reprise::cli

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "replay/trace_reader.h"

namespace reprise::exchange {

struct FoxgloveOptions {
    std::uint64_t first = 1;
    std::uint64_t last = 0;
    std::uint64_t every = 2;  ///< ticks; events are written whenever they happen

    /// Pictures and points named by tick (000120.png, .ply), or folders of such, as `reprise
    /// render` makes them; "": none.
    std::filesystem::path images;
};

/// What became of it, for a person.
struct FoxgloveExport {
    std::uint64_t messages = 0;
    std::uint64_t images = 0;
    std::uint64_t clouds = 0;  ///< of points
    bool located = false;      ///< the town lies somewhere on the globe
};

/// Writes what Foxglove and Lichtblick show: an MCAP file of Foxglove's own message types as JSON
/// (both read it surely, and so does everybody else).
///   /town      SceneUpdate      once: roads, buildings, trees
///   /actors    SceneUpdate      vehicles with name and numbers, cars, walkers, signals
///   /tf        FrameTransforms  of the vehicles with mass, by name
///   /log       Log              events: what the scenario printed, checks, collisions
///   /location  LocationFix      of the first of them, where the road network has a projection
///   /camera/.. CompressedImage  pictures, where there are some
///   /points/.. PointCloud       what LiDARs and radars measured, where there is some
FoxgloveExport export_foxglove(replay::TraceReader& trace,
                               const FoxgloveOptions& options,
                               const std::filesystem::path& out);

}  // namespace reprise::exchange

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace reprise::cli {

struct DatasetOptions {
    std::vector<std::string> traces;
    std::string output;
    std::string weathers = "recorded";
    std::string rig;  ///< a file of cameras; empty: one as `size` and `fov_deg` say
    std::string format = "kitti";
    std::string split = "train:0.8,val:0.2";
    std::string ticks;  ///< A..B; empty: all
    std::string every = "0.5s";
    std::string sweeps;  ///< of nuScenes, between the samples; empty: none
    std::string actor;   ///< its name or its id; empty: the first physics vehicle
    std::string size = "1242x375";
    double fov_deg = 82;
    int threads = 0;
    bool portable = false;
    std::string check;   ///< a data set that is made again and compared; empty: one is made
    bool quiet = false;  ///< says nothing of what it made

    /// As they were said, without those of the traces, the output, the rig and threads.
    std::vector<std::pair<std::string, std::string>> said;
};

/// Adds `dataset`.
void add_dataset(CLI::App& app, DatasetOptions& dataset);

/// After the words are read: of those that may not stand together. Throws CLI::ParseError.
void finish_dataset(const CLI::App& app, DatasetOptions& dataset);

}  // namespace reprise::cli

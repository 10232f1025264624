#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
}

namespace reprise::cli {

/// Who drives the actors that are spawned with driver = 'external'.
struct DriverOptions {
    std::vector<std::string> drivers;      ///< NAME=COMMAND or NAME=socket:PATH
    std::optional<double> driver_timeout;  ///< [s] of real time for an answer
};

struct RunOptions : DriverOptions {
    std::string scenario;
    std::string source;  ///< the scenario's text, where it is in no file; `scenario` is its name
    std::string output;  ///< empty: the scenario's name in the working directory
    std::optional<std::string> town;
    std::optional<std::uint64_t> seed;
    std::optional<double> seconds;
    std::optional<std::string> weather;    ///< a preset
    std::optional<double> friction;        ///< of the road
    std::optional<std::uint32_t> cars;     ///< of the traffic, or world::auto_cars
    std::optional<std::uint32_t> walkers;  ///< in the background
    std::vector<std::pair<std::string, std::string>> parameters;
    std::string level = "full";  ///< how much of each tick is kept
    bool watch = false;          ///< again whenever the scenario is saved
    std::string nudge;           ///< TICK[:ACTOR.FIELD[:UNITS]]; empty: none
};

struct BranchOptions : DriverOptions {
    std::string trace;
    std::string at;  ///< tick, or seconds with an s behind
    std::vector<std::string> scripts;
    std::string output;  ///< a trace, or with several scripts a folder
    std::optional<double> seconds;
    std::vector<std::pair<std::string, std::string>> parameters;
};

/// Adds `run`. What --set is given goes into `assignments`, as typed.
void add_run(CLI::App& app, RunOptions& run, std::vector<std::string>& assignments);

/// Adds `branch`, likewise.
void add_branch(CLI::App& app, BranchOptions& branch, std::vector<std::string>& assignments);

/// What a run may be given besides its scenario: --town, --seed, --set, --for.
void add_start(CLI::App& command, RunOptions& run, std::vector<std::string>& assignments);

/// --driver and --driver-timeout.
void add_drivers(CLI::App& command, DriverOptions& options);

/// KEY=VALUE in its two parts. Throws CLI::ValidationError.
std::pair<std::string, std::string> split_assignment(const std::string& text);

}  // namespace reprise::cli

#include "cli/town/trial_drives.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "cli/process/helper_program.h"
#include "cli/process/temporary_folder.h"
#include "files/output_file.h"
#include "process/program.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;

constexpr int drives = 3;  ///< each with another seed: its driver begins elsewhere
constexpr process::Limits drive_limits{.memory = std::uint64_t{8} << 30, .seconds = 600};

constexpr std::uint32_t most_cars = 100;  ///< around the driver; in a large town they are elsewhere

constexpr const char* scenario = R"lua(-- A minute in traffic, by the built-in driver.
return scenario 'trial' {{
    cars = {}, duration = 60,
    run = function() spawn{{ name = 'ego', model = 'sedan', driver = 'autopilot', may_overtake = true }} wait(60) end,
}}
)lua";

process::Program drive(const fs::path& town, const TemporaryFolder& folder, int seed) {
    process::Program program;
    program.name = helper_program("reprise-run");
    program.words = {"run",
                     folder / "trial.lua",
                     "--town",
                     town,
                     "--seed",
                     fmt::format("{}", seed),
                     "--level",
                     "inputs",
                     "-o",
                     folder / fmt::format("{}.mcap", seed)};
    program.limits = drive_limits;
    return program;
}

/// The line that says why it ended, without who says it: a library's own words come first.
std::string reason_of(const process::ProgramResult& result) {
    if (!result.stopped.empty())
        return result.stopped;
    std::string_view said = result.said;
    for (const std::string_view mark : {"Assertion", "reprise: "})
        if (const auto at = said.find(mark); at != std::string_view::npos) {
            const auto start = said.rfind('\n', at) + 1;  // of the text, where there is none
            said = said.substr(start, said.find('\n', at) - start);
            break;
        }
    for (const std::string_view before : {"reprise: ", "./src/"})
        if (said.starts_with(before))
            said.remove_prefix(before.size());
    return said.empty() ? fmt::format("exit code {}", result.code) : std::string(said);
}

}  // namespace

towns::Criterion check_driving(const towns::Network& network, std::uint32_t cars) {
    const TemporaryFolder folder;
    const fs::path town = folder / (network.name + ".net.xml");
    files::write_file(town, "the network", network.xml);
    if (!network.place.empty())
        files::write_file(folder / (network.name + ".place.xml"), "the place", network.place);
    files::write_file(
        folder / "trial.lua", "the scenario", fmt::format(scenario, std::min(cars, most_cars)));
    std::vector<process::Program> programs;
    for (int seed = 1; seed <= drives; ++seed)
        programs.push_back(drive(town, folder, seed));
    std::vector<towns::Criterion::Place> ended;
    int number = 0;
    for (const process::ProgramResult& result :
         process::run_programs(process::Children(2), programs)) {
        ++number;
        if (result.code != 0 || result.signal != 0)
            ended.push_back({fmt::format("drive {}: {}", number, reason_of(result)),
                             Eigen::Vector2d::Zero(),
                             1});
    }
    return towns::none_of(
        "drives that ended early",
        std::move(ended),
        fmt::format("{} of a minute, in traffic", world::count_of(drives, "drive")));
}

}  // namespace reprise::cli

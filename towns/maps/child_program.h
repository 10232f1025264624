#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace reprise::towns {

/// What another program may use before it is stopped.
struct ProgramLimits {
    std::uint64_t memory = std::uint64_t{4} << 30;  ///< [bytes] of address space
    std::uint64_t seconds = 600;                    ///< of processor time
    std::uint64_t file = std::uint64_t{2} << 30;    ///< [bytes] of one file that it writes
};

struct ProgramResult {
    int code = 0;         ///< exit code; meaningless when a signal ended it
    std::string stopped;  ///< what ended it early, such as "crashed (signal 11)"; empty: nothing
    std::string said;     ///< the first 256 kB of both its outputs
};

/// Runs a program of SUMO's and waits: `words` go to it as they are, through no shell. It is looked
/// for in PATH, then in /usr/bin. SUMO_HOME is set for it, its locale is C. It works in the folder
/// `scratch`, so that words need no paths: SUMO's programs split those at commas. Throws
/// world::Error that names the package when there is no such program.
ProgramResult run_program(const std::string& name,
                          const std::vector<std::string>& words,
                          const std::filesystem::path& scratch,
                          const ProgramLimits& limits = {});

/// Where Debian's SUMO keeps its type maps. Not SUMO_HOME: equal maps make equal towns everywhere.
std::filesystem::path sumo_folder();

}  // namespace reprise::towns

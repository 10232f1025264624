#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "process/children.h"
#include "process/limits.h"

namespace reprise::process {

/// Another program, and how it is to run. It gets no input.
struct Program {
    /// A path (from `folder` on), or a name that is looked for in PATH, then in /usr/bin.
    std::string name;
    std::vector<std::string> words{};      ///< go to it as they are, through no shell
    std::filesystem::path folder{};        ///< in which it works; empty: in ours
    std::filesystem::path log{};           ///< gets both its outputs; empty: the result does
    std::size_t most_said = 256 << 10;     ///< [bytes] of its outputs in the result, the first ones
    std::vector<std::string> variables{};  ///< NAME=value, in place of ours of those names
    bool only_these_variables = false;     ///< none of ours
    std::string package{};                 ///< Debian's, which has it; for who has it not
    Limits limits{};
};

struct ProgramResult : Ended {
    std::string stopped;  ///< by which signal, such as "crashed (signal 11, ...)"; empty: by none
    std::string said;     ///< both its outputs in the order written
};

/// Where a program of that name is: looked for in PATH, then in /usr/bin; a name with a '/' is its
/// path. Nothing where there is none: a word that is built into shells is not.
std::optional<std::string> path_of_program(const std::string& name);

/// Waits for it. Throws world::Error that names the package when there is no such program.
ProgramResult run_program(const Program& program);

/// Some at a time; results in the order of `programs`. `waiting` as in Children::run.
std::vector<ProgramResult> run_programs(
    const Children& children,
    const std::vector<Program>& programs,
    const std::function<void(std::size_t through)>& waiting = {});

}  // namespace reprise::process

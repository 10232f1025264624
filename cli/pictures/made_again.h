// Private to the room: whether what manifests say is made again.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/options/options.h"
#include "cli/pictures/file_list.h"
#include "cli/process/temporary_folder.h"

namespace reprise::cli {

/// How to make what was made once.
struct Recipe {
    std::vector<std::string>
        words;  ///< of the program and its command, what it reads, where its output goes
    const nlohmann::ordered_json&
        said;          ///< a manifest or an index: its "options", and its "rig" if it has one
    int threads = 0;   ///< as many as the program likes
    std::string what;  ///< is made again, for people
};

/// Reads a recipe as the program's own command line; the rig becomes a file of `folder`. Throws
/// world::Error when it is none.
void parse_again(const Recipe& recipe, const TemporaryFolder& folder, CommandLine& line);

/// Whether this program is the one that a manifest names.
bool same_program(const nlohmann::ordered_json& manifest);

/// Which of these parts of a manifest or an index, at `path`, is not what it would say now: a
/// sentence, or nothing. Another program may word them in another way: of its manifests nothing.
std::string untrue_part(const nlohmann::ordered_json& then,
                        const nlohmann::ordered_json& now,
                        const std::filesystem::path& path,
                        std::initializer_list<const char*> parts);

/// Says whether files were made again as they were, and as they still are in `root`; else the first
/// that differs; and `untrue`, if it is anything. `what` is that what was checked, for people.
/// Returns the exit code.
int tell_made_again(const std::string& what,
                    const std::filesystem::path& root,
                    const FileList& then,
                    const FileList& now,
                    bool same_program,
                    const std::string& untrue);

}  // namespace reprise::cli

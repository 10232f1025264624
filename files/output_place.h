#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace reprise::files {

/// What stands where something is to be written.
enum class PlaceKind : std::uint8_t {
    file,    ///< a plain file, or nothing yet
    folder,  ///< a folder
    stream   ///< a device, a pipe, an open descriptor (/dev/stdout): must never be replaced
};

struct OutputPlace {
    std::filesystem::path path;  ///< behind all links: those stay, and what they name is written
    PlaceKind kind = PlaceKind::file;
};

/// Where a path that the user named leads to. Throws world::Error when its links go in a circle.
OutputPlace output_place(const std::filesystem::path& named);

/// The plain file that a path leads to. Throws world::Error that names `what` ("the trace") when
/// something else stands there, or when there is no folder for it.
std::filesystem::path output_target(const std::filesystem::path& named, const std::string& what);

/// What the system says about an error number when a file was written; a limit on the size of
/// files (ulimit -f) is named with its value.
std::string write_error(int error);

}  // namespace reprise::files

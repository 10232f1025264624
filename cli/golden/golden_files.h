#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace reprise::cli {

/// Throws world::Error when no file can be written there, as far as that can be told beforehand.
void check_writable(const std::filesystem::path& path);

/// Moves a file, also from one file system to another; makes the folders on the way.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

/// Copies a file; it appears under its name when it is whole.
void copy_file_whole(const std::filesystem::path& from, const std::filesystem::path& to);

/// The last lines of a text file.
std::string last_lines(const std::filesystem::path& path, std::size_t count);

/// Traces kept by content: FOLDER/<chain>.mcap, where equal chains mean equal histories.
void keep_trace(const std::filesystem::path& trace,
                const std::string& chain,
                const std::filesystem::path& folder);
std::optional<std::filesystem::path> kept_trace(const std::string& chain,
                                                const std::filesystem::path& folder);

/// Removes a file that an earlier call left, and the folders that are empty without it.
void remove_stale(const std::filesystem::path& path, const std::filesystem::path& output);

/// Where in `output` the files of something go that lies at `path`: never the same for two places,
/// and never outside of it.
std::filesystem::path place_in(const std::filesystem::path& output,
                               const std::filesystem::path& path);

}  // namespace reprise::cli

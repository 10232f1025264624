#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "files/output_file.h"
#include "process/companion.h"

namespace reprise::cli {

/// How a film's program is told where its pictures come from.
inline constexpr const char* film_variable = "REPRISE_FILM";

/// What it says when it has begun, and when the film is whole; anything else is what went wrong.
inline constexpr const char* film_begun = "begun\n";
inline constexpr const char* film_whole = "whole\n";

/// A film on its way to its file, through the program that has FFmpeg in it. The file appears when
/// it is whole. Throws world::Error.
class FilmPipe {
  public:
    /// To be made before there are threads: they would not hold signals meanwhile.
    FilmPipe(const std::filesystem::path& path,
             const std::string& ending,
             int width,
             int height,
             double rate);
    ~FilmPipe();
    FilmPipe(const FilmPipe&) = delete;
    FilmPipe& operator=(const FilmPipe&) = delete;

    /// One picture: R, G, B of each pixel, by rows.
    void add(std::span<const std::uint8_t> rgb);

    void finish();

  private:
    std::string hear();
    [[noreturn]] void fail(const std::string& said);

    std::filesystem::path path_;
    std::optional<files::OutputFile> file_;
    int socket_ = -1;
    std::optional<process::Companion> program_;
};

}  // namespace reprise::cli

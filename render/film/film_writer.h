#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace reprise::render {

/// What a film is like.
struct FilmFormat {
    int width = 0;  ///< [px] even
    int height = 0;
    double rate = 20;    ///< [pictures/s]
    std::string ending;  ///< .mp4 and .mkv (H.264), .webm (VP8), .avi (Motion JPEG)
};

/// Writes a film, picture by picture. Throws world::Error.
class FilmWriter {
  public:
    /// `path` has the format's ending; what stands there is replaced.
    FilmWriter(const std::filesystem::path& path, const FilmFormat& format);
    ~FilmWriter();
    FilmWriter(const FilmWriter&) = delete;
    FilmWriter& operator=(const FilmWriter&) = delete;

    /// Width times height times R, G, B.
    void add(std::span<const std::uint8_t> rgb);

    /// Ends the film, and reads it again: FFmpeg says nothing of a disk that is full.
    void finish();

  private:
    struct Writer;
    std::unique_ptr<Writer> writer_;
};

}  // namespace reprise::render

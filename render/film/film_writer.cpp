#include "render/film/film_writer.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "world/check.h"

namespace reprise::render {

namespace {

/// The most usual one that plays everywhere: a format's first that this FFmpeg has.
std::vector<int> codecs_of(const std::string& ending) {
    using cv::VideoWriter;
    if (ending == ".webm")
        return {VideoWriter::fourcc('V', 'P', '8', '0')};
    if (ending == ".avi")
        return {VideoWriter::fourcc('M', 'J', 'P', 'G')};
    REPRISE_CHECK(ending == ".mp4" || ending == ".mkv", ending);
    return {ending == ".mp4" ? VideoWriter::fourcc('a', 'v', 'c', '1')
                             : VideoWriter::fourcc('H', '2', '6', '4'),
            VideoWriter::fourcc('m', 'p', '4', 'v')};
}

}  // namespace

struct FilmWriter::Writer {
    std::filesystem::path path;
    FilmFormat format;
    cv::VideoWriter film;
    cv::Mat picture;
    std::uint64_t pictures = 0;
};

FilmWriter::FilmWriter(const std::filesystem::path& path, const FilmFormat& format)
    : writer_(std::make_unique<Writer>()) {
    REPRISE_CHECK(format.width > 0 && format.width % 2 == 0 && format.height > 0 &&
                      format.height % 2 == 0 && format.rate > 0,
                  fmt::format("{} x {} at {}", format.width, format.height, format.rate));
    // What goes wrong, we say.
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    writer_->path = path;
    writer_->format = format;
    writer_->picture.create(format.height, format.width, CV_8UC3);
    for (const int codec : codecs_of(format.ending))
        if (writer_->film.open(path.string(),
                               cv::CAP_FFMPEG,
                               codec,
                               format.rate,
                               cv::Size(format.width, format.height)))
            return;
    throw world::Error("FFmpeg cannot write a film there of that format and size");
}

FilmWriter::~FilmWriter() = default;

void FilmWriter::add(std::span<const std::uint8_t> rgb) {
    const auto size = static_cast<std::size_t>(writer_->picture.total()) * 3;
    REPRISE_CHECK(rgb.size() == size, std::to_string(rgb.size()) + " bytes");
    // OpenCV keeps blue first.
    std::uint8_t* target = writer_->picture.ptr<std::uint8_t>();
    for (std::size_t i = 0; i < size; i += 3) {
        target[i] = rgb[i + 2];
        target[i + 1] = rgb[i + 1];
        target[i + 2] = rgb[i];
    }
    writer_->film.write(writer_->picture);
    ++writer_->pictures;
}

void FilmWriter::finish() {
    writer_->film.release();
    cv::VideoCapture reader(writer_->path.string(), cv::CAP_FFMPEG);
    std::uint64_t found = 0;
    while (reader.isOpened() && reader.grab())
        ++found;
    if (found != writer_->pictures)
        throw world::Error(
            fmt::format("only {} of {} pictures could be read back: is the disk full?",
                        found,
                        writer_->pictures));
}

}  // namespace reprise::render

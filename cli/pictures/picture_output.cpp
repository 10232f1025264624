#include "cli/pictures/picture_output.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/pictures/calibration.h"
#include "files/output_file.h"
#include "render/event_file.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

render::DepthCoding coding_of(const std::string& word) {
    using enum render::DepthCoding;
    return word == "mm"      ? millimetres
           : word == "kitti" ? kitti
           : word == "carla" ? carla
                             : centimetres;
}

bool is_of_floats(const world::SensorFrame& frame) {
    return frame.type == world::PixelType::f32;
}

}  // namespace

PictureFolders::PictureFolders(const RenderOptions& options,
                               const Cameras& cameras,
                               WrittenFiles& files)
    : options_(options),
      cameras_(cameras),
      files_(files),
      coding_(coding_of(options.depth_coding)),
      view_(!options.no_view) {
    const std::filesystem::path folder = options.output;
    const world::SensorRig& sensors = cameras.sensors();
    for (const world::SensorSpec& sensor : sensors)
        of_sensors_.push_back(cameras.has_folders() ? folder / sensor.name : folder);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        for_people_.push_back(sensors[i].kind == world::SensorKind::rgb);
        made_.emplace_front(for_people_[i] || !view_ ? of_sensors_[i] : of_sensors_[i] / "view");
        if (options.boxes)
            made_.emplace_front(of_sensors_[i] / "boxes");
    }
}

void PictureFolders::write(const world::SensorFrame& frame,
                           const std::filesystem::path& folder) const {
    if (frame.kind == world::SensorKind::dvs)
        return render::write_events(frame,
                                    folder / fmt::format("{:06}.{}", frame.tick, options_.events));
    if (options_.npy && is_of_floats(frame))
        return render::write_npy(frame, noted(folder / fmt::format("{:06}.npy", frame.tick)));
    if (options_.exr && is_of_floats(frame))
        return render::write_exr(frame, noted(folder / fmt::format("{:06}.exr", frame.tick)));
    const bool mapped = frame.kind == world::SensorKind::semantic && options_.classes == "paper";
    render::write_png(mapped ? render::in_paper_classes(frame) : frame,
                      noted(folder / fmt::format("{:06}.png", frame.tick)),
                      render::Texture::grainy,
                      coding_);
}

/// A file that is about to be written.
std::filesystem::path PictureFolders::noted(std::filesystem::path path) const {
    files_.add(path);
    return path;
}

void PictureFolders::take(std::size_t sensor,
                          const world::SensorFrame& frame,
                          const world::SensorFrame& shown) {
    write(for_people_[sensor] ? shown : frame, of_sensors_[sensor]);
    if (!for_people_[sensor] && view_)
        render::write_png(
            shown,
            noted(of_sensors_[sensor] / "view" / fmt::format("{:06}.png", frame.tick)),
            render::Texture::flat);
}

void PictureFolders::take_boxes(std::size_t sensor,
                                std::uint64_t tick,
                                const std::string& text,
                                const world::SensorFrame& /*instances*/) {
    files::write_file(
        noted(of_sensors_[sensor] / "boxes" / fmt::format("{:06}.json", tick)), "the boxes", text);
}

void PictureFolders::finish() {
    if (!options_.calibration && options_.rig.empty())
        return;
    for (std::size_t i = 0; i < of_sensors_.size(); ++i)
        if (std::filesystem::is_directory(of_sensors_[i])) {
            write_calibration(of_sensors_[i], cameras_.sensors()[i], cameras_.carrier(i));
            noted(of_sensors_[i] / "camera.json");
            noted(of_sensors_[i] / "calib.txt");
        }
}

Film::Film(const std::filesystem::path& path,
           const std::string& ending,
           const Cameras& cameras,
           double rate,
           std::size_t strips,
           WrittenFiles& files)
    : path_(path),
      files_(files),
      strips_(strips) {
    const world::SensorRig& sensors = cameras.sensors();
    if (sensors.size() != 1) {
        std::vector<std::string> names;
        for (const world::SensorSpec& sensor : sensors)
            names.push_back(sensor.name);
        throw world::Error(
            fmt::format("{}: a film shows one camera, and here are {} ({}): say --preset, or "
                        "--sensor with one kind",
                        path.string(),
                        names.size(),
                        fmt::join(names, ", ")));
    }
    pipe_.emplace(path, ending, sensors[0].width, sensors[0].height, rate);
}

void Film::take(std::size_t /*sensor*/,
                const world::SensorFrame& /*frame*/,
                const world::SensorFrame& shown) {
    if (strips_ == 1)
        return add(shown.data);
    // Rows of pixels, three bytes each.
    const auto width = static_cast<std::size_t>(shown.width);
    const std::size_t from = width * taken_ / strips_;
    const std::size_t to = width * (taken_ + 1) / strips_;
    composed_.resize(shown.data.size());
    for (std::size_t row = 0; row < static_cast<std::size_t>(shown.height); ++row) {
        const auto at = [&](std::size_t column) {
            return static_cast<std::ptrdiff_t>(3 * (row * width + column));
        };
        std::copy(shown.data.begin() + at(from),
                  shown.data.begin() + at(to),
                  composed_.begin() + at(from));
        if (taken_ > 0)  // a line between two of them
            std::fill_n(composed_.begin() + at(from), 3 * std::min<std::size_t>(2, to - from), 255);
    }
    if (++taken_ < strips_)
        return;
    taken_ = 0;
    add(composed_);
}

void Film::add(const std::vector<std::uint8_t>& rgb) {
    pictures_.add_bytes(rgb.data(), rgb.size());
    pipe_->add(rgb);
}

void Film::finish() {
    pipe_->finish();
    files_.add(path_, world::to_hex(pictures_.digest128()));
}

}  // namespace reprise::cli

#include "cli/pictures/picture_output.h"

#include <fmt/format.h>

#include "render/picture.h"
#include "world/check.h"

namespace reprise::cli {

PictureFolders::PictureFolders(const std::filesystem::path& folder,
                               const Cameras& cameras,
                               bool view)
    : view_(view) {
    const world::SensorRig& sensors = cameras.sensors();
    for (const world::SensorSpec& sensor : sensors)
        of_sensors_.push_back(cameras.recorded() || sensors.size() > 1 ? folder / sensor.name
                                                                       : folder);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        for_people_.push_back(sensors[i].kind == world::SensorKind::rgb);
        made_.emplace_front(for_people_[i] || !view ? of_sensors_[i] : of_sensors_[i] / "view");
    }
}

void PictureFolders::take(std::size_t sensor,
                          const world::SensorFrame& frame,
                          const world::SensorFrame& shown) {
    const std::string name = fmt::format("{:06}.png", frame.tick);
    render::write_png(for_people_[sensor] ? shown : frame, of_sensors_[sensor] / name);
    if (!for_people_[sensor] && view_)
        render::write_png(shown, of_sensors_[sensor] / "view" / name, render::Texture::flat);
}

Film::Film(const std::filesystem::path& path,
           const std::string& ending,
           const Cameras& cameras,
           double rate) {
    const world::SensorRig& sensors = cameras.sensors();
    if (sensors.size() != 1) {
        std::vector<std::string> names;
        for (const world::SensorSpec& sensor : sensors)
            names.push_back(sensor.name);
        throw world::Error(
            fmt::format("{}: a film shows one camera, and here are {} ({}): say --preset, or "
                        "--camera with one kind",
                        path.string(),
                        names.size(),
                        fmt::join(names, ", ")));
    }
    pipe_.emplace(path, ending, sensors[0].width, sensors[0].height, rate);
}

void Film::take(std::size_t /*sensor*/,
                const world::SensorFrame& /*frame*/,
                const world::SensorFrame& shown) {
    pipe_->add(shown.data);
}

void Film::finish() {
    pipe_->finish();
}

}  // namespace reprise::cli

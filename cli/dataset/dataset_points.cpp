#include "cli/dataset/dataset_points.h"

#include "cli/dataset/nuscenes_points.h"
#include "files/output_file.h"
#include "render/point_file.h"
#include "render/ranging/untwist.h"

namespace reprise::cli {

DatasetPoints::DatasetPoints(const DatasetLayout& layout,
                             std::string weather,
                             std::map<std::uint64_t, Moment> moments,
                             std::size_t sensors,
                             const world::TownT& town,
                             bool labels)
    : layout_(layout),
      weather_(std::move(weather)),
      moments_(std::move(moments)),
      sensors_(sensors),
      labels_(labels) {
    if (sensors_ > layout_.rays().size())
        parked_ = render::parked_vehicles(town);
}

bool DatasetPoints::is_twin(std::size_t sensor) const {
    return sensor == layout_.rays().size();
}

std::filesystem::path DatasetPoints::path_of(std::size_t sensor, const Moment& moment) const {
    return is_twin(sensor) ? layout_.beams(moment.id) : layout_.points(sensor, weather_, moment);
}

bool DatasetPoints::wants(std::size_t sensor, std::uint64_t tick) const {
    const auto found = moments_.find(tick);
    const bool weathered = !is_twin(sensor) && layout_.is_weathered(sensor);
    return found != moments_.end() && (labels_ || weathered) &&
           !std::filesystem::exists(path_of(sensor, found->second));
}

bool DatasetPoints::wants_any() const {
    for (std::size_t i = 0; i < sensors_; ++i)
        for (const auto& [tick, moment] : moments_)
            if (wants(i, tick))
                return true;
    return false;
}

void DatasetPoints::take(std::size_t sensor,
                         const world::TickView& tick,
                         const world::SensorSpec& placed,
                         world::SensorFrame frame) {
    const std::filesystem::path path = path_of(sensor, moments_.at(tick.index()));
    render::untwist(frame, tick, placed);
    if (is_twin(sensor))
        return files::write_file(path, "the beams", beam_text(frame, tick, placed, parked_));
    const bool ours = layout_.format() != DatasetFormat::nuscenes || !layout_.is_weathered(sensor);
    if (ours)
        render::write_points(
            frame,
            path,
            path.extension() == ".bin" ? render::PointFormat::bin : render::PointFormat::npy);
    else
        files::write_file(path,
                          "the points",
                          placed.kind == world::SensorKind::radar
                              ? nuscenes_detections(frame, tick, placed)
                              : nuscenes_sweep(frame, placed));
    ++sweeps_;
}

}  // namespace reprise::cli

#include "cli/dataset/dataset_points.h"

#include "render/point_file.h"
#include "render/ranging/untwist.h"

namespace reprise::cli {

DatasetPoints::DatasetPoints(const DatasetLayout& layout,
                             std::string weather,
                             std::map<std::uint64_t, std::size_t> ids,
                             bool labels)
    : layout_(layout),
      weather_(std::move(weather)),
      ids_(std::move(ids)),
      labels_(labels) {}

bool DatasetPoints::wants(std::size_t sensor, std::uint64_t tick) const {
    const auto found = ids_.find(tick);
    return found != ids_.end() && (labels_ || layout_.is_weathered(sensor)) &&
           !std::filesystem::exists(layout_.points(sensor, weather_, found->second));
}

bool DatasetPoints::wants_any() const {
    for (std::size_t i = 0; i < layout_.rays().size(); ++i)
        for (const auto& [tick, id] : ids_)
            if (wants(i, tick))
                return true;
    return false;
}

void DatasetPoints::take(std::size_t sensor,
                         const world::TickView& tick,
                         const world::SensorSpec& placed,
                         world::SensorFrame frame) {
    render::untwist(frame, tick, placed);
    const std::filesystem::path path = layout_.points(sensor, weather_, ids_.at(tick.index()));
    render::write_points(
        frame,
        path,
        path.extension() == ".bin" ? render::PointFormat::bin : render::PointFormat::npy);
    ++sweeps_;
}

}  // namespace reprise::cli

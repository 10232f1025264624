#include "cli/dataset/dataset_output.h"

#include "cli/dataset/labels.h"
#include "cli/pictures/calibration.h"
#include "files/output_file.h"

namespace reprise::cli {

DatasetOutput::DatasetOutput(const DatasetLayout& layout,
                             std::string weather,
                             std::map<std::uint64_t, Moment> moments,
                             bool labels)
    : layout_(layout),
      weather_(std::move(weather)),
      moments_(std::move(moments)),
      labels_(labels) {}

/// Files appear whole, so that what is there is done.
bool DatasetOutput::wants(std::size_t sensor, std::uint64_t tick) const {
    const auto found = moments_.find(tick);
    if (found == moments_.end() || (!layout_.is_rgb(sensor) && !labels_))
        return false;
    const Moment& moment = found->second;
    // The label is written last.
    return !std::filesystem::exists(layout_.picture(sensor, weather_, moment)) ||
           (labels_ && layout_.is_rgb(sensor) &&
            !std::filesystem::exists(layout_.label(sensor, moment.id)));
}

bool DatasetOutput::wants_any() const {
    for (std::size_t i = 0; i < layout_.cameras().size(); ++i)
        for (const auto& [tick, moment] : moments_)
            if (wants(i, tick))
                return true;
    return false;
}

void DatasetOutput::take(std::size_t sensor,
                         const world::SensorFrame& frame,
                         const world::SensorFrame& shown) {
    render::write_png(layout_.is_rgb(sensor) ? shown : frame,
                      layout_.picture(sensor, weather_, moments_.at(frame.tick)),
                      render::Texture::grainy,
                      render::DepthCoding::kitti);
    ++pictures_;
}

void DatasetOutput::take_boxes(std::size_t sensor,
                               std::uint64_t tick,
                               const std::string& text,
                               const world::SensorFrame& instances) {
    if (!layout_.is_rgb(sensor))
        return;
    const std::size_t id = moments_.at(tick).id;
    const world::SensorSpec& camera = layout_.cameras()[sensor];
    const auto velodyne = layout_.velodyne();
    files::write_file(layout_.boxes(sensor, id), "the boxes", text);
    if (layout_.format() == DatasetFormat::nuscenes)
        return;
    files::write_file(layout_.calibration(sensor, id),
                      "the calibration",
                      kitti_calibration(camera, velodyne ? &layout_.rays()[*velodyne] : nullptr));
    files::write_file(layout_.label(sensor, id),
                      "the label",
                      layout_.format() == DatasetFormat::coco ? coco_annotations(text, instances)
                                                              : kitti_labels(text, camera));
}

}  // namespace reprise::cli

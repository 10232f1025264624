#include "cli/dataset/dataset_layout.h"

#include <set>
#include <system_error>

#include <fmt/format.h>

#include "cli/dataset/nuscenes_names.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

std::string numbered_file(std::size_t id, const char* ending) {
    return fmt::format("{:06}.{}", id, ending);
}

void make_link(const fs::path& target, const fs::path& link) {
    std::error_code error;
    if (!fs::is_symlink(link))
        fs::create_directory_symlink(target, link, error);
    if (error)
        throw world::Error(link.string() + ": cannot be made a link: " + error.message());
}

}  // namespace

DatasetLayout::DatasetLayout(fs::path root,
                             DatasetFormat format,
                             world::SensorRig cameras,
                             world::SensorRig rays,
                             bool sweeps)
    : root_(std::move(root)),
      format_(format),
      cameras_(std::move(cameras)),
      rays_(std::move(rays)),
      sweeps_(sweeps) {}

bool DatasetLayout::is_rgb(std::size_t camera) const {
    return cameras_[camera].kind == world::SensorKind::rgb;
}

bool DatasetLayout::is_weathered(std::size_t sensor) const {
    return rays_[sensor].kind != world::SensorKind::semantic_lidar;
}

std::optional<std::size_t> DatasetLayout::velodyne() const {
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (rays_[i].kind == world::SensorKind::lidar)
            return i;
    return std::nullopt;
}

/// nuScenes'.
fs::path DatasetLayout::of_channel(const std::string& weather,
                                   const std::string& channel,
                                   const Moment& moment,
                                   const char* ending) const {
    const fs::path folder = root_ / folder_of(weather);
    if (!moment.is_sweep())
        return folder / "samples" / channel / numbered_file(moment.id, ending);
    return folder / "sweeps" / channel /
           fmt::format("{:06}-{:04}.{}", moment.id, moment.before, ending);
}

fs::path DatasetLayout::points(std::size_t sensor,
                               const std::string& weather,
                               const Moment& moment) const {
    const std::size_t id = moment.id;
    const std::string& name = rays_[sensor].name;
    if (!is_weathered(sensor))
        return root_ / "labels" / name / numbered_file(id, "npy");
    const std::string folder = folder_of(weather);
    if (format_ == DatasetFormat::coco)
        return root_ / "points" / folder / name / numbered_file(id, "npy");
    if (format_ == DatasetFormat::nuscenes)
        return of_channel(weather,
                          ray_channel(sensor),
                          moment,
                          rays_[sensor].kind == world::SensorKind::radar ? "pcd" : "pcd.bin");
    const fs::path training = root_ / folder / "training";
    return sensor == velodyne() ? training / "velodyne" / numbered_file(id, "bin")
                                : training / name / numbered_file(id, "npy");
}

fs::path DatasetLayout::beams(std::size_t id) const {
    return root_ / "labels" / "beams" / numbered_file(id, "json");
}

fs::path DatasetLayout::tables(const std::string& weather) const {
    return root_ / folder_of(weather) / "v1.0-mini";
}

fs::path DatasetLayout::maps() const {
    return root_ / "labels" / "maps";
}

std::string DatasetLayout::camera_channel(std::size_t camera) const {
    return nuscenes_channel(cameras_[camera], false);
}

std::string DatasetLayout::ray_channel(std::size_t sensor) const {
    return nuscenes_channel(rays_[sensor], sensor == velodyne());
}

/// KITTI's colour cameras are 2 and 3; more of them count on.
std::string DatasetLayout::numbered(const char* name, std::size_t camera) const {
    std::size_t number = 2;
    for (std::size_t i = 0; i < camera; ++i)
        number += is_rgb(i) ? 1 : 0;
    return fmt::format("{}_{}", name, number);
}

std::string DatasetLayout::file_name(std::size_t camera, std::size_t id) const {
    return cameras_[camera].name + "/" + numbered_file(id, "png");
}

fs::path DatasetLayout::picture(std::size_t camera,
                                const std::string& weather,
                                const Moment& moment) const {
    const std::size_t id = moment.id;
    if (!is_rgb(camera))
        return root_ / "labels" / file_name(camera, id);
    const fs::path folder = folder_of(weather);
    switch (format_) {
        case DatasetFormat::coco:
            return root_ / "images" / folder / file_name(camera, id);
        case DatasetFormat::nuscenes:
            return of_channel(weather, camera_channel(camera), moment, "png");
        default:
            return root_ / folder / "training" / numbered("image", camera) /
                   numbered_file(id, "png");
    }
}

fs::path DatasetLayout::boxes(std::size_t camera, std::size_t id) const {
    return root_ / "labels" / ("boxes_" + cameras_[camera].name) / numbered_file(id, "json");
}

fs::path DatasetLayout::label(std::size_t camera, std::size_t id) const {
    switch (format_) {
        case DatasetFormat::coco:
            return root_ / "labels" / ("coco_" + cameras_[camera].name) / numbered_file(id, "json");
        case DatasetFormat::nuscenes:
            return boxes(camera, id);
        default:
            return root_ / "labels" / numbered("label", camera) / numbered_file(id, "txt");
    }
}

fs::path DatasetLayout::calibration(std::size_t camera, std::size_t id) const {
    const std::string numbered_folder = numbered("calib", camera);
    return root_ / "labels" / (numbered_folder == "calib_2" ? "calib" : numbered_folder) /
           numbered_file(id, "txt");
}

std::vector<fs::path> DatasetLayout::folders(const std::vector<std::string>& weathers) const {
    std::set<fs::path> all;
    const bool nuscenes = format_ == DatasetFormat::nuscenes;
    if (!nuscenes)
        all.insert(root_ / (format_ == DatasetFormat::coco ? "annotations" : "ImageSets"));
    else
        all.insert(maps());
    if (nuscenes && velodyne())
        all.insert(beams(0).parent_path());
    for (const std::string& weather : weathers)
        if (nuscenes)
            all.insert(tables(weather));
    for (std::size_t i = 0; i < cameras_.size(); ++i) {
        for (const std::string& weather : weathers)
            all.insert(picture(i, weather, 0).parent_path());
        if (!is_rgb(i))
            continue;
        all.insert(boxes(i, 0).parent_path());
        all.insert(label(i, 0).parent_path());
        if (!nuscenes)
            all.insert(calibration(i, 0).parent_path());
    }
    for (std::size_t i = 0; i < rays_.size(); ++i)
        for (const std::string& weather : weathers)
            all.insert(points(i, weather, 0).parent_path());
    const Moment sweep(0, 1);
    for (const std::string& weather : weathers) {
        for (std::size_t i = 0; sweeps_ && i < cameras_.size(); ++i)
            all.insert(picture(i, weather, sweep).parent_path());
        for (std::size_t i = 0; sweeps_ && i < rays_.size(); ++i)
            all.insert(points(i, weather, sweep).parent_path());
    }
    return {all.begin(), all.end()};
}

std::vector<WrittenFile> DatasetLayout::files(const std::vector<std::string>& weathers) const {
    std::vector<WrittenFile> all;
    for (const fs::path& folder : folders(weathers))
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().extension() != ".partial")
                all.push_back({entry.path(), ""});
    return all;
}

void DatasetLayout::link(const std::vector<std::string>& weathers) const {
    if (format_ == DatasetFormat::coco)
        return;
    for (const std::string& weather : weathers) {
        const fs::path folder = root_ / folder_of(weather);
        if (format_ == DatasetFormat::nuscenes) {
            make_link("../labels/maps", folder / "maps");
            continue;
        }
        make_link("../ImageSets", folder / "ImageSets");
        for (std::size_t i = 0; i < cameras_.size(); ++i) {
            if (!is_rgb(i))
                continue;
            for (const fs::path& file : {label(i, 0), calibration(i, 0)}) {
                const fs::path name = file.parent_path().filename();
                make_link("../../labels" / name, folder / "training" / name);
            }
        }
    }
}

std::string DatasetLayout::folder_of(const std::string& weather) {
    std::string name = weather;
    for (char& letter : name)
        if (letter == ',' || letter == ':' || letter == ';')
            letter = '+';
    return name;
}

}  // namespace reprise::cli

#include "cli/dataset/dataset_lists.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/dataset/labels.h"
#include "files/json_text.h"
#include "files/output_file.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// KITTI's: which frames are of which part.
void write_image_sets(const fs::path& folder,
                      const std::vector<Split>& splits,
                      const std::vector<DatasetFrame>& frames) {
    for (const Split& split : splits) {
        std::string text;
        for (std::size_t id = 0; id < frames.size(); ++id)
            if (frames[id].split == split.name)
                text += fmt::format("{:06}\n", id);
        files::write_file(folder / (split.name + ".txt"), "the list", text);
    }
}

/// One file for each part: pictures, and what is on them.
void write_coco(const fs::path& folder,
                const DatasetLayout& layout,
                const std::vector<Split>& splits,
                const std::vector<DatasetFrame>& frames) {
    const world::SensorRig& cameras = layout.cameras();
    for (const Split& split : splits) {
        Json json{{"images", Json::array()}, {"annotations", Json::array()}};
        json["categories"] = Json::parse(coco_categories());
        for (std::size_t id = 0; id < frames.size(); ++id)
            for (std::size_t i = 0; i < cameras.size(); ++i) {
                if (frames[id].split != split.name || !layout.is_rgb(i))
                    continue;
                const std::size_t image = json["images"].size() + 1;
                json["images"].push_back({{"id", image},
                                          {"file_name", layout.file_name(i, id)},
                                          {"width", cameras[i].width},
                                          {"height", cameras[i].height}});
                Json annotations =
                    Json::parse(files::json_text(layout.label(i, id)), nullptr, false);
                if (!annotations.is_array())
                    throw world::Error(layout.label(i, id).string() + ": was changed; remove it");
                for (Json& one : annotations) {
                    one["id"] = json["annotations"].size() + 1;
                    one["image_id"] = image;
                    json["annotations"].push_back(std::move(one));
                }
            }
        files::write_file(
            folder / ("instances_" + split.name + ".json"), "the annotations", json.dump() + "\n");
    }
}

}  // namespace

void write_lists(const DatasetLayout& layout,
                 const std::vector<Split>& splits,
                 const std::vector<DatasetFrame>& frames) {
    if (layout.format() == DatasetFormat::coco)
        write_coco(layout.root() / "annotations", layout, splits, frames);
    else
        write_image_sets(layout.root() / "ImageSets", splits, frames);
}

}  // namespace reprise::cli

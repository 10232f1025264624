#pragma once

#include <vector>

#include "cli/dataset/dataset_layout.h"
#include "cli/dataset/frame_list.h"

namespace reprise::cli {

/// Writes what says of a whole data set which frames belong where: KITTI's ImageSets,
/// COCO's annotations. Throws world::Error.
void write_lists(const DatasetLayout& layout,
                 const std::vector<Split>& splits,
                 const std::vector<DatasetFrame>& frames);

}  // namespace reprise::cli

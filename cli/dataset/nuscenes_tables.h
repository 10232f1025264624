#pragma once

#include <list>
#include <string>
#include <vector>

#include "cli/dataset/dataset_layout.h"
#include "cli/dataset/dataset_source.h"
#include "cli/dataset/frame_list.h"

namespace reprise::cli {

/// Writes the thirteen tables of each weather's folder, and the masks of maps. Tokens do not depend
/// on the weather: what is under one is found under the others by the same token. Throws
/// world::Error.
void write_nuscenes(const DatasetLayout& layout,
                    const std::list<DatasetSource>& sources,
                    const std::vector<std::string>& weathers,
                    const std::vector<DatasetFrame>& frames);

}  // namespace reprise::cli

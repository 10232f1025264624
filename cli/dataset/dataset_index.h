// Private to the room: what dataset.json says.
#pragma once

#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "cli/dataset/dataset_layout.h"
#include "cli/dataset/dataset_source.h"
#include "cli/dataset/frame_list.h"
#include "cli/options/dataset_options.h"

namespace reprise::cli {

/// What dataset.json says: what a data set is made from, and its frames.
nlohmann::ordered_json index_of(const DatasetOptions& options,
                                const std::list<DatasetSource>& sources,
                                const std::vector<std::string>& weathers,
                                const std::vector<DatasetFrame>& frames,
                                const DatasetLayout& layout);

void write_index(const std::filesystem::path& path, const nlohmann::ordered_json& index);

/// Throws world::Error when it is none.
nlohmann::ordered_json read_index(const std::filesystem::path& path);

/// Throws world::Error where another data set lies there.
void check_index(const std::filesystem::path& path, const nlohmann::ordered_json& index);

}  // namespace reprise::cli

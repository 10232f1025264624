#include "cli/dataset/dataset_index.h"

#include <fstream>
#include <map>

#include <fmt/format.h>

#include "cli/dataset/nuscenes_map.h"
#include "cli/pictures/manifest.h"
#include "files/json_text.h"
#include "files/output_file.h"
#include "world/check.h"
#include "world/fingerprint.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// What must be the same when the rest of a data set is made; where its traces lie may change, and
/// how its frames were said.
Json kept_part(Json index) {
    const Json said = index.value("options", Json::object());
    index["actor"] = said.is_object() ? said.value("--actor", Json()) : Json();
    for (const char* key : {"complete", "options", "files"})
        index.erase(key);
    if (index.contains("traces") && index["traces"].is_array())
        for (Json& trace : index["traces"])
            if (trace.is_object())
                trace.erase("path");
    return index;
}

constexpr const char* any_weather = "{weather}";

/// Where a sensor's files lie, for loaders: with {weather} and {id}.
std::string file_pattern(const DatasetLayout& layout, const fs::path& first) {
    std::string name = first.filename().string();
    name.replace(0, name.find('.'), "{id}");
    return (first.parent_path().lexically_relative(layout.root()) / name).string();
}

}  // namespace

Json index_of(const DatasetOptions& options,
              const std::list<DatasetSource>& sources,
              const std::vector<std::string>& weathers,
              const std::vector<DatasetFrame>& frames,
              const DatasetLayout& layout) {
    Json json;
    json["dataset"] = 1;
    json["complete"] = false;
    json["format"] = options.format;
    for (const auto& [key, value] : world::build_fingerprint())
        json["program"][key] = value;
    json["portable"] = options.portable;
    for (const DatasetSource& source : sources)
        json["traces"].push_back({{"path", source.path()}, {"chain", chain_text(source.trace())}});
    for (const std::string& weather : weathers)
        json["weathers"].push_back(
            {{"said", weather}, {"folder", DatasetLayout::folder_of(weather)}});
    if (layout.format() == DatasetFormat::nuscenes) {
        const std::vector<NuscenesMap> maps = nuscenes_maps(sources, frames);
        for (std::size_t i = 0; i < sources.size(); ++i)
            json["traces"][i]["origin"] = {map_of(maps, i).origin().x(),
                                           map_of(maps, i).origin().y()};
    }
    json["cameras"] = Json::array();
    for (std::size_t i = 0; i < layout.cameras().size(); ++i) {
        Json& one = json["cameras"].emplace_back(Json::parse(sensor_text(layout.cameras()[i])));
        one["files"] = file_pattern(layout, layout.picture(i, any_weather, 0));
    }
    json["rays"] = Json::array();
    for (std::size_t i = 0; i < layout.rays().size(); ++i) {
        Json& one = json["rays"].emplace_back(Json::parse(sensor_text(layout.rays()[i])));
        one["files"] = file_pattern(layout, layout.points(i, any_weather, 0));
    }
    json["options"] = Json::object();
    for (const auto& [name, value] : options.said)
        json["options"][name] = value;
    if (!options.rig.empty())
        json["rig"] = Json::parse(std::ifstream(options.rig, std::ios::binary));
    if (sources.front().sweep() > 0)
        json["sweeps"] = {{"every", sources.front().sweep()}};
    json["split"] = options.split;
    std::map<std::string, std::size_t> counts;
    for (const DatasetFrame& frame : frames)
        ++counts[frame.split];
    for (const Split& split : read_split(options.split))
        json["frames_of"][split.name] = counts[split.name];
    for (std::size_t id = 0; id < frames.size(); ++id)
        json["frames"].push_back({{"id", id},
                                  {"trace", frames[id].trace},
                                  {"tick", frames[id].tick},
                                  {"split", frames[id].split}});
    return json;
}

namespace {

/// Folders in it do not count: they are what was made before the first file, when we were killed;
/// nor does an index that was begun.
void check_empty(const fs::path& folder) {
    std::error_code error;
    for (const fs::directory_entry& one : fs::recursive_directory_iterator(
             folder, fs::directory_options::skip_permission_denied, error))
        if (!one.is_directory() && one.path() != folder / "dataset.json.partial")
            throw world::Error(
                fmt::format("{}: holds {}, and is no data set; name a new or empty folder for -o",
                            folder.string(),
                            one.path().lexically_relative(folder).string()));
}

}  // namespace

void write_index(const fs::path& path, const Json& index) {
    files::write_file(path, "the index", index.dump(1) + "\n");
}

Json read_index(const fs::path& path) {
    if (!std::ifstream(path).is_open() || !fs::is_regular_file(path))
        throw world::Error(path.string() + ": cannot be read");
    Json json = Json::parse(files::json_text(path), nullptr, false);
    if (json.is_discarded() || !json.is_object() || json.value("dataset", Json()) != 1)
        throw world::Error(path.string() + ": this is no index that reprise dataset wrote");
    return json;
}

void check_index(const fs::path& path, const Json& index) {
    if (!fs::exists(path))
        return check_empty(path.parent_path());
    const Json old = kept_part(read_index(path));
    const Json wanted = kept_part(index);
    for (const auto& [key, value] : wanted.items())
        if (!old.contains(key) || old[key] != value)
            throw world::Error(fmt::format(
                "{}: another data set lies there: '{}' differs; name another folder for -o",
                path.string(),
                key));
}

}  // namespace reprise::cli

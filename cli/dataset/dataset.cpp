// What it must do: the same files whatever was there of them before, and however often it was
//   stopped meanwhile; labels once, as they are the same under every weather.
// How it goes: the list of frames follows from traces and options; then trace by trace and weather
//   by weather, frames at once; labels with the first weather; what is there is left alone.
#include "cli/dataset/dataset.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <list>
#include <map>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/dataset/dataset_output.h"
#include "cli/dataset/frame_list.h"
#include "cli/dataset/labels.h"
#include "cli/options/option_checks.h"
#include "cli/options/tick_option.h"
#include "cli/options/tick_range.h"
#include "cli/pictures/manifest.h"
#include "cli/pictures/renderer.h"
#include "cli/pictures/rig_file.h"
#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "files/output_file.h"
#include "world/check.h"
#include "world/fingerprint.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// Cameras and ticks of one trace.
struct Source {
    RenderOptions options;
    std::unique_ptr<replay::TraceReader> trace;
    Ticks ticks;
    std::unique_ptr<Cameras> cameras;
};

RenderOptions options_for(const DatasetOptions& dataset, const std::string& trace) {
    RenderOptions options;
    options.trace = trace;
    options.output = dataset.output;
    options.rig = dataset.rig;
    options.cameras = {"rgb"};
    options.recorded_rig = false;
    options.no_view = true;
    options.every = dataset.every;
    options.actor = dataset.actor;
    options.fov_deg = dataset.fov_deg;
    options.threads = dataset.threads;
    options.portable = dataset.portable;
    try {
        const PictureSize size = read_picture_size(dataset.size, "1242x375");
        options.width = size.width;
        options.height = size.height;
    } catch (const world::Error& error) {
        throw world::Error(std::string("--size: ") + error.what());
    }
    return options;
}

Source open_source(const DatasetOptions& dataset, const std::string& path) {
    Source source{options_for(dataset, path), nullptr, {}, nullptr};
    source.trace = std::make_unique<replay::TraceReader>(path);
    const TickRange range = parse_ticks("--ticks", dataset.ticks, *source.trace);
    source.ticks.from = range.first;
    source.ticks.to = range.last;
    source.ticks.every = parse_tick("--every", dataset.every, source.trace->episode().step_ns, 0);
    if (source.ticks.every < 1)
        throw world::Error("--every: expected 1 tick at least, got '" + dataset.every + "'");
    return source;
}

void look_through(Source& source) {
    const std::string& rig = source.options.rig;
    if (!rig.empty())
        for (const world::SensorSpec& sensor : read_rig_file(rig, *source.trace).rig.sensors)
            if (!world::is_camera(sensor.kind))
                throw world::Error(fmt::format(
                    "{}: sensor '{}': a data set holds what cameras see; reprise render --rig "
                    "writes what a {} measures",
                    rig,
                    sensor.name,
                    world::EnumNameSensorKind(sensor.kind)));
    source.cameras = std::make_unique<Cameras>(source.options, *source.trace, source.ticks);
}

void add_frames(const Source& source, std::size_t number, std::vector<DatasetFrame>& frames) {
    const std::size_t before = frames.size();
    for (std::uint64_t tick = source.ticks.from; tick <= source.ticks.to;
         tick += source.ticks.every) {
        const world::TickView view = source.trace->tick(tick).view;
        bool all = source.cameras->actor(view).has_value();
        for (std::size_t i = 0; all && i < source.cameras->sensors().size(); ++i)
            all = source.cameras->is_there(i, view);
        if (all)
            frames.push_back({number, tick, ""});
    }
    if (frames.size() == before)
        throw world::Error("no vehicle to mount the cameras on in these ticks of " +
                           source.options.trace);
}

Json index_of(const DatasetOptions& options,
              const std::vector<Source>& sources,
              const std::vector<std::string>& weathers,
              const std::vector<DatasetFrame>& frames) {
    Json json;
    json["dataset"] = 1;
    json["complete"] = false;
    json["format"] = options.format;
    for (const auto& [key, value] : world::build_fingerprint())
        json["program"][key] = value;
    json["portable"] = options.portable;
    for (const Source& source : sources)
        json["traces"].push_back(
            {{"path", source.options.trace}, {"chain", chain_text(*source.trace)}});
    for (const std::string& weather : weathers)
        json["weathers"].push_back(
            {{"said", weather}, {"folder", DatasetLayout::folder_of(weather)}});
    for (const world::SensorSpec& camera : sources.front().cameras->sensors())
        json["cameras"].push_back(Json::parse(sensor_text(camera)));
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

void write_index(const fs::path& path, const Json& index) {
    files::write_file(path, "the index", index.dump(1) + "\n");
}

/// What must be the same when the rest of a data set is made; where its traces lie may change.
Json kept_part(Json index) {
    index.erase("complete");
    if (index.contains("traces") && index["traces"].is_array())
        for (Json& trace : index["traces"])
            if (trace.is_object())
                trace.erase("path");
    return index;
}

/// Throws where another data set lies there.
void check_index(const fs::path& path, const Json& index) {
    std::ifstream file(path, std::ios::binary);
    if (!file.is_open())
        return;
    const Json there = Json::parse(file, nullptr, false);
    if (there.is_discarded() || !there.is_object())
        throw world::Error(path.string() + ": this is no index that reprise dataset wrote");
    const Json old = kept_part(there);
    const Json wanted = kept_part(index);
    for (const auto& [key, value] : wanted.items())
        if (!old.contains(key) || old[key] != value)
            throw world::Error(fmt::format(
                "{}: another data set lies there: '{}' differs; name another folder for -o",
                path.string(),
                key));
}

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
                const world::SensorRig& cameras,
                const std::vector<Split>& splits,
                const std::vector<DatasetFrame>& frames) {
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
                std::ifstream file(layout.label(i, id), std::ios::binary);
                Json annotations = Json::parse(file, nullptr, false);
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

/// Everything of one trace that is not there yet; how many pictures that were.
std::size_t make_pictures(Source& source,
                          const std::string& name,
                          const DatasetLayout& layout,
                          const std::vector<std::string>& weathers,
                          const std::map<std::uint64_t, std::size_t>& ids,
                          bool coco) {
    std::optional<render::Sensors> sensors;
    std::size_t made = 0;
    const world::SensorRig& cameras = source.cameras->sensors();
    for (const std::string& weather : weathers) {
        const bool first = weather == weathers.front();
        source.options.boxes = first;
        DatasetOutput output(layout, cameras, weather, ids, coco, first);
        const bool nothing = std::none_of(ids.begin(), ids.end(), [&](const auto& one) {
            for (std::size_t i = 0; i < cameras.size(); ++i)
                if (output.wants(i, one.first))
                    return true;
            return false;
        });
        if (nothing)
            continue;
        if (!sensors)
            sensors.emplace(source.trace->recording().town,
                            render::Sensors::Options{.threads = source.options.threads,
                                                     .portable = source.options.portable});
        Renderer renderer(source.options, *source.trace, *source.cameras, output, {weather});
        renderer.look_at_all(*sensors, source.ticks, fmt::format("{}, {}", name, weather));
        made += output.pictures();
    }
    return made;
}

}  // namespace

int dataset(const DatasetOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<Split> splits = read_split(options.split);
    std::vector<std::string> weathers;
    try {
        weathers = weather_list(options.weathers);
    } catch (const world::Error& error) {
        throw world::Error(std::string("--weathers: ") + error.what());
    }
    std::vector<Source> sources;
    std::vector<std::string> chains;
    std::vector<DatasetFrame> frames;
    sources.reserve(options.traces.size());  // cameras refer to the options beside them
    for (const std::string& path : options.traces) {
        Source& source = sources.emplace_back(open_source(options, path));
        look_through(source);
        chains.push_back(chain_text(*source.trace));
        for (std::size_t i = 0; i + 1 < chains.size(); ++i)
            if (chains[i] == chains.back())
                throw world::Error(path + ": this trace is there twice");
        add_frames(source, sources.size() - 1, frames);
    }
    split_frames(splits, chains, frames);
    const world::SensorRig& cameras = sources.front().cameras->sensors();
    const bool coco = options.format == "coco";
    const fs::path root = options.output;
    const DatasetLayout layout(root, coco, cameras);
    if (std::none_of(cameras.begin(), cameras.end(), [](const world::SensorSpec& camera) {
            return camera.kind == world::SensorKind::rgb;
        }))
        throw world::Error(options.rig + ": a data set needs a camera of type rgb");
    Json index = index_of(options, sources, weathers, frames);
    check_index(root / "dataset.json", index);

    NewFolder whole(root);
    std::list<NewFolder> made;
    for (const fs::path& folder : layout.folders(weathers))
        made.emplace_front(folder);
    write_index(root / "dataset.json", index);
    std::size_t pictures = 0;
    for (std::size_t number = 0; number < sources.size(); ++number) {
        std::map<std::uint64_t, std::size_t> ids;
        for (std::size_t id = 0; id < frames.size(); ++id)
            if (frames[id].trace == number)
                ids[frames[id].tick] = id;
        const std::string name = fmt::format("trace {} of {}", number + 1, sources.size());
        pictures += make_pictures(sources[number], name, layout, weathers, ids, coco);
    }
    layout.link(weathers);
    if (coco)
        write_coco(root / "annotations", layout, cameras, splits, frames);
    else
        write_image_sets(root / "ImageSets", splits, frames);
    index["complete"] = true;
    write_index(root / "dataset.json", index);
    say("{}: {} frames of {} traces under {} weathers; {} pictures made in {:.1f} s\n",
        options.output,
        frames.size(),
        sources.size(),
        weathers.size(),
        pictures,
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    return exit_good;
}

}  // namespace reprise::cli

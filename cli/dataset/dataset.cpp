// What it must do: the same files whatever was there of them before, and however often it was
//   stopped meanwhile; labels once, as they are the same under every weather.
// How it goes: the list of frames follows from traces and options; then trace by trace and weather
//   by weather, frames at once; labels with the first weather; what is there is left alone.
#include "cli/dataset/dataset.h"

#include <algorithm>
#include <chrono>
#include <list>
#include <map>

#include <fmt/format.h>

#include "cli/dataset/check_dataset.h"
#include "cli/dataset/dataset_index.h"
#include "cli/dataset/dataset_lists.h"
#include "cli/dataset/dataset_output.h"
#include "cli/dataset/dataset_points.h"
#include "cli/dataset/dataset_source.h"
#include "cli/dataset/nuscenes_tables.h"
#include "cli/pictures/made_again.h"
#include "cli/pictures/manifest.h"
#include "cli/pictures/renderer.h"
#include "cli/process/guard.h"
#include "cli/process/new_folder.h"
#include "cli/process/say.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

DatasetFormat format_of(const std::string& word) {
    return word == "coco"       ? DatasetFormat::coco
           : word == "nuscenes" ? DatasetFormat::nuscenes
                                : DatasetFormat::kitti;
}

std::vector<std::string> weathers_of(const DatasetOptions& options) {
    try {
        return weather_list(options.weathers);
    } catch (const world::Error& error) {
        throw world::Error(std::string("--weathers: ") + error.what());
    }
}

/// How many that were.
struct Made {
    std::size_t pictures = 0;
    std::size_t sweeps = 0;
};

/// Everything of one trace that is not there yet.
Made make_frames(DatasetSource& source,
                 const std::string& name,
                 const DatasetLayout& layout,
                 const std::vector<std::string>& weathers,
                 const std::map<std::uint64_t, Moment>& frames,
                 const std::map<std::uint64_t, Moment>& sweeps) {
    std::optional<render::Sensors> sensors;
    const auto look = [&]() -> render::Sensors& {
        const render::Sensors::Options how{.threads = source.options().threads,
                                           .portable = source.options().portable};
        return sensors ? *sensors : sensors.emplace(source.trace().recording().town, how);
    };
    Made made;
    const auto make = [&](const std::string& weather,
                          const std::map<std::uint64_t, Moment>& moments,
                          const Ticks& ticks,
                          bool labels) {
        source.options().boxes = labels;
        DatasetOutput output(layout, weather, moments, labels);
        if (output.wants_any()) {
            Renderer renderer(
                source.options(), source.trace(), source.cameras(), output, {weather});
            renderer.look_at_all(look(), ticks, fmt::format("{}, {}", name, weather));
        }
        DatasetPoints points(layout,
                             weather,
                             moments,
                             source.rays().sensors().size(),
                             source.trace().recording().town,
                             labels);
        if (points.wants_any())
            look_by_rays(source.rays(),
                         source.trace(),
                         source.ticks(),
                         ChosenWeather(weather, source.step()),
                         look(),
                         points);
        made.pictures += output.pictures();
        made.sweeps += points.sweeps();
    };
    Ticks between = source.ticks();
    between.every = std::max<std::uint64_t>(1, source.sweep());
    for (const std::string& weather : weathers) {
        make(weather, frames, source.ticks(), weather == weathers.front());
        if (!sweeps.empty())
            make(weather, sweeps, between, false);
    }
    return made;
}

}  // namespace

int dataset(const DatasetOptions& options) {
    if (!options.check.empty())
        return check_dataset(options, dataset);
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<Split> splits = read_split(options.split);
    const std::vector<std::string> weathers = weathers_of(options);
    std::list<DatasetSource> sources;
    std::vector<std::string> chains;
    std::vector<DatasetFrame> frames;
    for (const std::string& path : options.traces) {
        const DatasetSource& source = sources.emplace_back(options, path);
        chains.push_back(chain_text(source.trace()));
        for (std::size_t i = 0; i + 1 < chains.size(); ++i)
            if (chains[i] == chains.back())
                throw world::Error(path + ": this trace is there twice");
        source.add_frames(sources.size() - 1, frames);
    }
    split_frames(splits, chains, frames);
    const fs::path root = options.output;
    const DatasetLayout layout(root,
                               format_of(options.format),
                               sources.front().cameras().sensors(),
                               sources.front().own_rays(),
                               !options.sweeps.empty());
    nlohmann::ordered_json index = index_of(options, sources, weathers, frames, layout);
    check_index(root / "dataset.json", index);

    NewFolder whole(root);
    std::list<NewFolder> folders;
    for (const fs::path& folder : layout.folders(weathers))
        folders.emplace_front(folder);
    write_index(root / "dataset.json", index);
    Made made;
    std::size_t number = 0;
    for (DatasetSource& source : sources) {
        std::map<std::uint64_t, Moment> moments;
        for (std::size_t id = 0; id < frames.size(); ++id)
            if (frames[id].trace == number)
                moments[frames[id].tick] = id;
        const std::map<std::uint64_t, Moment> sweeps = source.sweeps(number, frames);
        const std::string name = fmt::format("trace {} of {}", ++number, sources.size());
        const Made more = make_frames(source, name, layout, weathers, moments, sweeps);
        made.pictures += more.pictures;
        made.sweeps += more.sweeps;
    }
    if (layout.format() == DatasetFormat::nuscenes)
        write_nuscenes(layout, sources, weathers, frames);
    else
        write_lists(layout, splits, frames);
    layout.link(weathers);
    index["files"] = file_list(layout.files(weathers), root);
    index["complete"] = true;
    write_index(root / "dataset.json", index);
    if (options.quiet)
        return exit_good;
    say("{}: {} of {} under {}; {}{} made in {:.1f} s\n",
        options.output,
        world::count_of(frames.size(), "frame"),
        world::count_of(sources.size(), "trace"),
        world::count_of(weathers.size(), "weather"),
        world::count_of(made.pictures, "picture"),
        made.sweeps == 0 ? "" : " and " + world::count_of(made.sweeps, "point cloud"),
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    return exit_good;
}

}  // namespace reprise::cli

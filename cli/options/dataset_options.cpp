#include "cli/options/dataset_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"

namespace reprise::cli {

void add_dataset(CLI::App& app, DatasetOptions& dataset) {
    CLI::App& command = *app.add_subcommand(
        "dataset", "Make a data set: many traces under many weathers, labels once");
    // Asked for by hand: --check knows both.
    command.add_option("traces", dataset.traces, "The traces")
        ->type_name("T.mcap REQUIRED")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("-o,--output",
                    dataset.output,
                    "Its folder; where a part of the same data set lies there, the rest is made")
        ->type_name("DIR REQUIRED");
    command
        .add_option("--check",
                    dataset.check,
                    "Make a data set again, elsewhere, and compare byte for byte; needs no -o, and "
                    "traces only where they are no longer in their places")
        ->type_name("DIR");
    command
        .add_option("--weathers",
                    dataset.weathers,
                    "Such as clear_noon,cloudy_noon,snow=1,hard_rain_sunset; all18: the CARLA "
                    "paper's; recorded (default)")
        ->type_name("WEATHER,...");
    command
        .add_option(
            "--rig",
            dataset.rig,
            "Sensors of a file, see docs/rendering.md: under each weather there are pictures "
            "of rgb and points of LiDARs and radars, of all else one")
        ->type_name("RIG.json");
    command
        .add_option("--format", dataset.format, "The layout (default kitti): see docs/datasets.md")
        ->type_name("kitti|coco|nuscenes")
        ->check(one_of({"kitti", "coco", "nuscenes"}, "format"));
    command
        .add_option("--split",
                    dataset.split,
                    "Shares of whole traces, or of one trace's time (default train:0.8,val:0.2)")
        ->type_name("NAME:SHARE,...");
    add_ticks(command, dataset.ticks);
    command.add_option("--every", dataset.every, "Every so many ticks, or time (default 0.5s)")
        ->type_name("N");
    command
        .add_option("--sweeps",
                    dataset.sweeps,
                    "Of nuScenes: what sensors see between the samples, every so many ticks, or "
                    "time, of which --every is a multiple")
        ->type_name("N");
    command
        .add_option("--actor",
                    dataset.actor,
                    "Who carries the sensors, in every trace: a name or an id (default: the first "
                    "vehicle with a rig, or the first); a rig's \"actor\" comes first")
        ->type_name("NAME");
    command.add_option("--size", dataset.size, "Without a rig (default 1242x375)")
        ->type_name("WxH");
    command
        .add_option(
            "--fov", dataset.fov_deg, "Without a rig: horizontal field of view (default 82)")
        ->type_name("DEGREES")
        ->check(a_number_in(1, 170));
    command
        .add_option("--threads", dataset.threads, "How many work on pictures (default: all cores)")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
    command.add_flag(
        "--portable", dataset.portable, "Pictures whose bytes are the same on every x86-64 CPU");
    command.footer(
        "Stopped, by Ctrl-C or a full disk, the same command goes on where it was.\n"
        "Example: reprise dataset a.mcap b.mcap -o set --weathers clear_noon,hard_rain_sunset "
        "--rig rig.json\n"
        "         reprise dataset --check set");
}

void finish_dataset(const CLI::App& app, DatasetOptions& dataset) {
    const CLI::App& command = *app.get_subcommand("dataset");
    if (!command.parsed())
        return;
    if (!dataset.check.empty())
        check_alone(command);
    else if (dataset.traces.empty())
        throw CLI::RequiredError("traces");
    else if (dataset.output.empty())
        throw CLI::RequiredError("--output");
    dataset.said = said_words(command);
}

}  // namespace reprise::cli

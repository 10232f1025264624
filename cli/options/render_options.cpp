#include "cli/options/render_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"
#include "world/check.h"
#include "world/external/rig.h"
#include "world/external/sensor.h"
#include "world/external/sensor_attributes.h"
#include "world/words.h"

namespace reprise::cli {

namespace {

void read_size(const std::string& text, RenderOptions& render) {
    try {
        const PictureSize size = read_picture_size(text, "800x600");
        render.width = size.width;
        render.height = size.height;
    } catch (const world::Error& error) {
        throw CLI::ValidationError("--size", error.what());
    }
}

void read_threads(const std::string& text, RenderOptions& render) {
    constexpr int most = 1024;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, render.threads);
    if (error != std::errc() || stop != end || render.threads < 1 || render.threads > most)
        throw CLI::ValidationError("--threads",
                                   "expected a number of threads from 1 to " +
                                       std::to_string(most) + ", got '" + text + "'");
}

/// Each kind has one folder.
void check_cameras(const std::vector<std::string>& cameras) {
    for (auto camera = cameras.begin(); camera != cameras.end(); ++camera)
        if (std::find(cameras.begin(), camera, *camera) != camera)
            throw CLI::ValidationError("--sensor", "'" + *camera + "' is there twice");
}

std::string lower_case_ending(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension();
    for (char& letter : ending)
        if (letter >= 'A' && letter <= 'Z')
            letter = static_cast<char>(letter - 'A' + 'a');
    return ending;
}

void read_mount(const std::string& text, RenderOptions& render) {
    int used = 0;
    std::vector<double>& at = render.mount;
    const int found = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &at[0], &at[1], &at[2], &used);
    const bool are_numbers = std::all_of(at.begin(), at.end(), [](double x) {
        return std::isfinite(x);  // "nan" and "inf" are read as well
    });
    if (found != 3 || used != static_cast<int>(text.size()) || !are_numbers)
        throw CLI::ValidationError("--mount", "expected X,Y,Z such as 1,0,1.4, got '" + text + "'");
    // As of every sensor that is mounted, in a rig file or a scenario.
    for (const double x : at)
        if (std::abs(x) > world::farthest_mount)
            throw CLI::ValidationError("--mount",
                                       "expected at most " +
                                           std::to_string(static_cast<int>(world::farthest_mount)) +
                                           " m along each axis, got '" + text + "'");
}

/// Of kinds, what is not said otherwise.
std::string joined_but_first(const std::vector<std::string>& kinds) {
    return joined({kinds.begin() + 1, kinds.end()});
}

/// Of all kinds that are asked for.
std::vector<const world::AttributeRow*> known_attributes(const RenderOptions& render) {
    std::vector<const world::AttributeRow*> rows;
    for (const std::vector<std::string>& kinds : {render.cameras, render.measured})
        for (const std::string& name : kinds)
            for (const world::AttributeRow& row : world::attribute_rows())
                if (row.is_of(*world::find_sensor_kind(name)))
                    rows.push_back(&row);
    return rows;
}

double attribute_value(const world::AttributeRow& row, const std::string& text) {
    if (!row.words.empty()) {
        try {
            return world::value_of_word(row, text);
        } catch (const world::WrongWord& wrong) {
            throw CLI::ValidationError("--attribute", wrong.what());
        }
    }
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (text.empty() || error != std::errc() || stop != end)
        throw CLI::ValidationError("--attribute",
                                   "expected NAME=NUMBER such as channels=64, got '" +
                                       std::string(row.name) + "=" + text + "'");
    return value;
}

void read_attributes(const CLI::App& command,
                     const std::vector<std::string>& words,
                     RenderOptions& render) {
    const std::vector<const world::AttributeRow*> rows = known_attributes(render);
    for (const std::string& word : words) {
        const std::size_t split = word.find('=');
        const std::string name = word.substr(0, split);
        const auto row = std::find_if(
            rows.begin(), rows.end(), [&](const auto* one) { return one->name == name; });
        if (split == std::string::npos)
            throw CLI::ValidationError(
                "--attribute", "expected NAME=NUMBER such as channels=64, got '" + word + "'");
        if (row == rows.end() && command.get_option_no_throw("--" + name) != nullptr)
            throw CLI::ValidationError("--attribute",
                                       "none of these sensors has an attribute '" + name +
                                           "' (did you mean '--" + name + "'?)");
        if (row == rows.end()) {
            std::vector<std::string> known;
            for (const world::AttributeRow* one : rows)
                known.emplace_back(one->name);
            throw CLI::ValidationError("--attribute",
                                       "none of these sensors has an attribute '" + name + "'" +
                                           world::did_you_mean(name, known));
        }
        render.attributes.push_back({name, attribute_value(**row, word.substr(split + 1))});
    }
}

/// What is no camera goes its own way.
void part_kinds(RenderOptions& render) {
    std::vector<std::string> cameras;
    for (const std::string& kind : render.cameras) {
        const bool camera = world::is_camera(*world::find_sensor_kind(kind));
        (camera ? cameras : render.measured).push_back(kind);
    }
    render.cameras = std::move(cameras);
}

/// What only cameras have.
void check_view(const CLI::App& command, const RenderOptions& render) {
    if (!render.cameras.empty() || render.measured.empty())
        return;
    for (const char* option : {"--size",
                               "--fov",
                               "--own-car",
                               "--preset",
                               "--overlay",
                               "--boxes",
                               "--calibration",
                               "--depth-coding",
                               "--classes",
                               "--events",
                               "--npy",
                               "--exr"})
        if (command.count(option) > 0)
            throw CLI::ValidationError(
                option,
                "is of cameras, and of --sensor " + joined(render.measured) + " none is one");
}

/// What programs read: how it is coded, and what comes with it.
void add_labels(CLI::App& command, RenderOptions& render) {
    command.add_option("--rig", render.rig, "Sensors of a file, see docs/rendering.md")
        ->type_name("RIG.json");
    command
        .add_option("--depth-coding",
                    render.depth_coding,
                    "Of depths along the optical axis in PNG: cm (default, 16 bits, to 655 m), mm "
                    "(to 65 m), kitti (1/256 m, to 256 m) or carla (24 bits of a kilometre)")
        ->type_name("CODING")
        ->check(one_of({"cm", "mm", "kitti", "carla"}, "coding"));
    command.add_flag(
        "--npy",
        render.npy,
        "depth [m], flow [px] and normals as they are: float32 arrays, DIR/000120.npy");
    command.add_flag("--exr", render.exr, "The same as EXR of 32-bit floats: DIR/000120.exr");
    command
        .add_option("--events",
                    render.events,
                    "Of dvs: DIR/000120.npy (default) or .csv, each event's x, y, t [ns], pol")
        ->type_name("npy|csv")
        ->check(one_of({"npy", "csv"}, "format"));
    command
        .add_option("--classes",
                    render.classes,
                    "Of semantic: CARLA 0.9.14's 29 (carla, default) or its paper's 12 (paper)")
        ->type_name("carla|paper")
        ->check(one_of({"carla", "paper"}, "table of classes"));
    command.add_flag("--own-car", render.own_car, "Who carries a camera is in its pictures");
    command.add_flag(
        "--boxes",
        render.boxes,
        "Of all that is seen boxes in the picture and in space, DIR/boxes/000120.json");
    command.add_flag(
        "--calibration",
        render.calibration,
        "DIR/camera.json and DIR/calib.txt (KITTI): what each camera is, and its place");
}

/// Whom to look at, from where, and what is written on it.
void add_views(CLI::App& command, RenderOptions& render, RenderWords& words) {
    command
        .add_option("--actor",
                    render.actor,
                    "Who carries the cameras, or is followed: a name or an id (default: the first "
                    "vehicle with a rig, or the first)")
        ->type_name("NAME");
    command
        .add_option("--preset",
                    render.preset,
                    "A camera that follows the actor: chase, from behind and above; top, from "
                    "above; driver, from its eye; orbit, around it")
        ->type_name("NAME")
        ->check(one_of({"chase", "top", "driver", "orbit"}, "preset"));
    command
        .add_option("--distance",
                    render.distance,
                    "Of the camera of chase, top or orbit (default: 5.5 behind; 55 above; by the "
                    "actor's size)")
        ->type_name("METRES")
        ->check(a_number_in(1, 1000));
    command.add_option("--up", words.up, "What is up in pictures from above (default north)")
        ->type_name("north|heading")
        ->check(one_of({"north", "heading"}, "direction"));
    command.add_flag("--overlay",
                     render.overlay,
                     "Write onto the pictures who is where and how fast, what happens, and when");
    command.add_flag("--no-view", render.no_view, "Without DIR/view/, which takes programs time");
}

/// A preset says itself where the camera is.
void check_preset(const CLI::App& command, const RenderOptions& render) {
    const auto refuse = [&](const char* option, const std::string& why) {
        if (command.count(option) > 0)
            throw CLI::ValidationError(option, why);
    };
    if (render.preset != "top")
        refuse("--up", "only of --preset top");
    if (render.preset.empty() || render.preset == "driver")
        refuse("--distance", "only of --preset chase, top or orbit");
    if (!render.preset.empty())
        for (const char* option : {"--mount", "--pitch", "--yaw"})
            refuse(option, "--preset " + render.preset + " says itself where the camera is");
}

/// A rig says itself what its sensors are; a film shows nothing but pictures.
void check_labels(const CLI::App& command, const RenderOptions& render) {
    if (!render.rig.empty())
        for (const char* option : {"--sensor",
                                   "--size",
                                   "--fov",
                                   "--mount",
                                   "--pitch",
                                   "--yaw",
                                   "--preset",
                                   "--attribute"})
            if (command.count(option) > 0)
                throw CLI::ValidationError(option, "--rig says itself what its sensors are");
    if (!film_ending(render.output).empty())
        for (const char* option : {"--boxes",
                                   "--calibration",
                                   "--npy",
                                   "--exr",
                                   "--depth-coding",
                                   "--events",
                                   "--points",
                                   "--readings"})
            if (command.count(option) > 0)
                throw CLI::ValidationError(option, "is of files in a folder, not of a film");
    if (!render.preset.empty() && render.calibration)
        throw CLI::ValidationError("--calibration",
                                   "a preset's camera is not mounted; --boxes says where it is");
}

/// Of a name that somebody means as a file and that we would make a folder of.
void check_output(const std::string& output) {
    constexpr std::array<std::string_view, 16> others{".apng",
                                                      ".bmp",
                                                      ".flv",
                                                      ".gif",
                                                      ".jpeg",
                                                      ".jpg",
                                                      ".m4v",
                                                      ".mov",
                                                      ".mpeg",
                                                      ".mpg",
                                                      ".ogg",
                                                      ".ogv",
                                                      ".png",
                                                      ".ts",
                                                      ".webp",
                                                      ".wmv"};
    const std::string ending = lower_case_ending(output);
    if (std::find(others.begin(), others.end(), ending) != others.end() &&
        !std::filesystem::is_directory(output))
        throw CLI::ValidationError(
            "--output",
            "expected a folder, or a film that ends in .mp4, .mkv, .webm or .avi, got '" + output +
                "'");
}

/// Of options that may not stand together.
void check_together(const CLI::App& command, const RenderOptions& render) {
    if (render.npy && render.exr)
        throw CLI::ValidationError("--exr", "says what --npy says: one of them");
    if (render.check.empty()) {
        if (render.trace.empty())
            throw CLI::RequiredError("trace");
        if (render.output.empty())
            throw CLI::RequiredError("--output");
    } else {
        check_alone(command);
    }
    if (!render.compare.empty() && film_ending(render.output).empty())
        throw CLI::ValidationError("--compare", "is of a film: -o run.mp4");
    if (!render.compare.empty() && !render.weather.empty())
        throw CLI::ValidationError("--compare", "says the weathers: without --weather");
}

}  // namespace

std::string film_ending(const std::string& output) {
    constexpr std::array<std::string_view, 4> films{".avi", ".mkv", ".mp4", ".webm"};
    const std::string ending = lower_case_ending(output);
    const bool is_film = std::find(films.begin(), films.end(), ending) != films.end();
    return is_film && !std::filesystem::is_directory(output) ? ending : "";
}

void add_render(CLI::App& app, RenderOptions& render, RenderWords& words) {
    CLI::App& command = *app.add_subcommand("render", "Render what cameras saw, from a trace");
    // Asked for by hand: --check knows both.
    command.add_option("trace", render.trace, "The trace")->type_name("T.mcap REQUIRED");
    command
        .add_option("-o,--output",
                    render.output,
                    "Folder for the pictures, or a film: a name that ends in .mp4, .mkv, .webm or "
                    ".avi")
        ->type_name("DIR|FILM REQUIRED");
    command
        .add_option("--weather",
                    render.weather,
                    "Another weather than recorded, such as wet_sunset, rain=30,fog=200, or "
                    "cloudy_noon,snow=1: see reprise list weathers; over time: "
                    "0s:clear_noon,30s:rain=20")
        ->type_name("PRESET,KEY=VALUE,...")
        ->check(a_weather_course());
    command
        .add_option("--compare",
                    render.compare,
                    "Of a film: these weathers side by side, such as clear_noon,hard_rain_sunset")
        ->type_name("WEATHER,...");
    command
        .add_option("--check",
                    render.check,
                    "Make all that a manifest is about again, and compare byte for byte; needs no "
                    "-o, and the trace only where it is no longer in its place")
        ->type_name("MANIFEST");
    command
        .add_option("--sensor,--camera",
                    render.cameras,
                    "rgb (default), " + joined_but_first(world::sensor_kinds()) +
                        "; several by commas, each into its own folder")
        ->type_name("KIND")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter(',')
        ->check(one_of(world::sensor_kinds(), "sensor"));
    command
        .add_option("--attribute",
                    words.attributes,
                    "Of sensors and lenses, as channels=64 or lens=fisheye; several by commas: see "
                    "docs/rendering.md and docs/sensors.md")
        ->type_name("NAME=VALUE")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter(',');
    command
        .add_option("--points",
                    render.points,
                    "How lidar, semantic_lidar and radar are written (default ply)")
        ->type_name("ply|pcd|bin|npy")
        ->check(one_of({"ply", "pcd", "bin", "npy"}, "format"));
    command
        .add_option("--readings",
                    render.readings,
                    "And gnss, imu, collision, lane_invasion, obstacle (default csv)")
        ->type_name("csv|npy")
        ->check(one_of({"csv", "npy"}, "format"));
    add_labels(command, render);
    add_views(command, render, words);
    command.add_option("--size", words.size, "Of the pictures (default 800x600)")->type_name("WxH");
    command
        .add_option("--fov",
                    render.fov_deg,
                    "Horizontal field of view, to 170, of a fisheye to 200 (default 90; of a "
                    "preset its own)")
        ->type_name("DEGREES")
        ->check(a_number_in(1, 200));
    add_ticks(command, render.ticks);
    // As ticks were chosen before: they go on working, and nobody is told of them.
    command.add_option("--from", render.from)->group("");
    command.add_option("--to", render.to)->group("");
    command
        .add_option("--every",
                    render.every,
                    "Every so many ticks, or time (default: as the rig does; else 1s, of a film "
                    "each tick)")
        ->type_name("N");
    command
        .add_option("--mount",
                    words.mount,
                    "Place on it: ahead of the rear axle, left, up (default 1,0,1.4)")
        ->type_name("X,Y,Z");
    command.add_option("--pitch", render.pitch_deg, "Camera up by this (default 0)")
        ->type_name("DEGREES")
        ->check(a_number_in(-360, 360));
    command.add_option("--yaw", render.yaw_deg, "Camera left by this (default 0)")
        ->type_name("DEGREES")
        ->check(a_number_in(-360, 360));
    command
        .add_option("--threads",
                    words.threads,
                    "How many work on a picture (default: all cores); the bytes stay the same")
        ->type_name("N");
    command.add_flag(
        "--portable",
        render.portable,
        "Make pictures whose bytes are the same on every x86-64 CPU (depth and semantic take "
        "twice as long, rgb 10 to 20 % longer)");
    command.footer(
        "Pictures are named by tick: DIR/000120.png. depth: 16-bit, centimetres; semantic: 8-bit\n"
        "class ids (CARLA 0.9.14); instance: 16-bit numbers; flow since the last tick: as KITTI;\n"
        "normals: 16-bit colour; DIR/view/ holds versions of these for people to look at.\n"
        "A vehicle that carries a rig is rendered with it, DIR/SENSOR/000120.png, at the ticks at\n"
        "which it saw, unless --camera, --size, --fov, --mount, --pitch, --yaw or --preset say "
        "other\n"
        "cameras. A film shows one camera, as fast as it was: --every says how many ticks a "
        "picture.\n"
        "Example: reprise render a.mcap -o rain --weather hard_rain_sunset --every 20\n"
        "         reprise render a.mcap -o run.mp4 --preset chase --overlay --weather wet_sunset");
}

void finish_render(const CLI::App& app, const RenderWords& words, RenderOptions& render) {
    const CLI::App& command = *app.get_subcommand("render");
    if (!command.parsed())
        return;
    check_together(command, render);
    render.said = said_words(command);
    read_size(words.size, render);
    if (!words.mount.empty())
        read_mount(words.mount, render);
    if (command.count("--threads") > 0)
        read_threads(words.threads, render);
    check_cameras(render.cameras);
    check_preset(command, render);
    check_labels(command, render);
    check_output(render.output);
    if (command.count("--ticks") > 0 && command.count("--from") + command.count("--to") > 0)
        throw CLI::ValidationError("--ticks", "says what --from and --to said: without these");
    render.heading_up = words.up == "heading";
    for (const char* option : {"--rig",
                               "--sensor",
                               "--size",
                               "--fov",
                               "--mount",
                               "--pitch",
                               "--yaw",
                               "--preset",
                               "--attribute"})
        if (command.count(option) > 0)
            render.recorded_rig = false;
    part_kinds(render);
    if (!render.measured.empty() && !film_ending(render.output).empty())
        throw CLI::ValidationError(
            "--sensor",
            "a film shows a camera, no " + render.measured.front() + ": give -o a folder");
    check_view(command, render);
    if (render.cameras.empty() && render.measured.empty())
        render.cameras = {"rgb"};
    read_attributes(command, words.attributes, render);
}

}  // namespace reprise::cli

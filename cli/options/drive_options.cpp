#include "cli/options/drive_options.h"

#include <cstdio>

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"
#include "world/external/rig.h"
#include "world/models/catalogue.h"

namespace reprise::cli {

namespace {

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const world::VehicleModel& model : world::vehicle_models())
        names.emplace_back(model.name);
    return names;
}

void add_camera(CLI::App& command, DriveOptions& drive, std::string& size) {
    command
        .add_option("--camera",
                    drive.camera,
                    "What you see: rgb, or semantic or depth, which take a sixth of the time")
        ->type_name("KIND")
        ->transform(one_of({"rgb", "semantic", "depth"}, "camera"))
        ->capture_default_str();
    command
        .add_option(
            "--place", drive.place, "Of the camera: at the wheel, or behind and above your own car")
        ->type_name("driver|chase")
        ->transform(one_of({"driver", "chase"}, "place"))
        ->capture_default_str();
    command
        .add_option("--size",
                    size,
                    "Of the pictures (default 256x144); the window scales them. Smaller ones are "
                    "faster")
        ->type_name("WxH");
    command.add_option("--every", drive.every, "A picture in so many ticks of 50 ms")
        ->type_name("TICKS")
        ->check(CLI::Range(1, 20))
        ->capture_default_str();
}

/// --view and --pace.
void add_wheel(CLI::App& command, WheelOptions& wheel) {
    command
        .add_option("--view",
                    wheel.view,
                    "Where you look: a window, the terminal, or auto: a window where one can be "
                    "opened")
        ->type_name("auto|window|terminal")
        ->transform(one_of({"auto", "window", "terminal"}, "view"))
        ->capture_default_str();
    command
        .add_option("--pace",
                    wheel.pace,
                    "Simulated over real time, at most: 1 is real time, 0.5 slow motion, 0 as fast "
                    "as it goes")
        ->type_name("FACTOR")
        ->check(a_number_in(0, 100))
        ->capture_default_str();
}

}  // namespace

void add_drive(CLI::App& app, DriveOptions& drive, std::string& size) {
    CLI::App& command = *app.add_subcommand("drive", "Drive yourself, by keys, in live traffic");
    command.add_option("--town", drive.town, "Where: as run --town has it")
        ->type_name("NET")
        ->capture_default_str();
    command.add_option("--model", drive.model, "What you drive")
        ->type_name("MODEL")
        ->transform(one_of(model_names(), "vehicle model"))
        ->capture_default_str();
    command.add_option("--weather", drive.weather, "Its pictures and its road friction")
        ->type_name("PRESET,KEY=VALUE,...")
        ->check(a_weather())
        ->capture_default_str();
    command
        .add_option(
            "--cars", drive.cars, "Other cars on the roads; auto: as many as the town carries")
        ->type_name("N|auto")
        ->transform(number_of_cars())
        ->capture_default_str();
    command.add_option("--walkers", drive.walkers, "People on foot")
        ->type_name("N")
        ->transform(number_of_walkers())
        ->capture_default_str();
    command.add_option("--seed", drive.seed, "Decides everything random, such as where you begin")
        ->type_name("N")
        ->transform(whole_number());
    command.add_flag("--goal", drive.goal, "A place to go to, drawn by the seed; it ends there");
    command.add_option("--for", drive.seconds, "End after this much simulated time")
        ->type_name("SECONDS")
        ->check(a_number_in(1, 86'400))
        ->capture_default_str();
    command.add_option("-o,--output", drive.output, "Where the trace goes")
        ->type_name("T.mcap")
        ->capture_default_str();
    add_camera(command, drive, size);
    add_wheel(command, drive.wheel);
    command.footer(
        "Keys: arrows or WASD drive, space is the hand brake, R reverse when the car stands, Tab\n"
        "another picture, P pause; Esc, Q or closing the window ends the drive, whose trace is "
        "whole.\n"
        "A gamepad, or a steering wheel that SDL takes for one, drives as well.\n"
        "The run waits for you and for the pictures: where they cannot be made in real time it is\n"
        "slower, as the window's title says, and what is recorded is the same.\n"
        "In scenarios of your own: reprise run my.lua --driver ego=keyboard\n"
        "Example: reprise drive --town town2 --goal -o mine.mcap && reprise verify mine.mcap");
}

void finish_drive(const std::string& size, DriveOptions& drive) {
    if (size.empty())
        return;
    int used = 0;
    const int found = std::sscanf(size.c_str(), "%5ux%5u%n", &drive.width, &drive.height, &used);
    const auto good = [](unsigned side) {
        return side >= 1 && side <= static_cast<unsigned>(world::largest_picture_side);
    };
    if (found != 2 || used != static_cast<int>(size.size()) || !good(drive.width) ||
        !good(drive.height))
        throw CLI::ValidationError("--size", "expected such as 256x144, got '" + size + "'");
}

std::optional<int> read_wheel(int argc, char** argv, WheelWords& words) {
    CLI::App app("A person drives in a run: reprise drive starts this.", "reprise-wheel");
    add_wheel(app, words.wheel);
    app.add_flag("--check", words.check, "Only see whether there is anything to look at");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return std::nullopt;
}

}  // namespace reprise::cli

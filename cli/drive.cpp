#include "cli/drive.h"

#include <numbers>

#include <fmt/format.h>

#include "cli/external/wheel_program.h"
#include "cli/run.h"
#include "world/check.h"
#include "world/lanes/density.h"
#include "world/models/catalogue.h"
#include "world/models/viewpoint.h"

namespace reprise::cli {

namespace {

/// The picture of a tick is made while the one before it is looked at.
constexpr int latency = 1;

constexpr const char* drive_text =
    R"lua(-- Somebody drives by hand.
return scenario 'drive' {{
    cars = {cars}, walkers = {walkers}, weather = '{weather}',
    params = {{ goal = {goal} }},

    run = function(p)
        local ego = spawn{{ name = 'ego', model = '{model}', driver = 'external', latency = {latency}, rig = {{
            {{ name = 'view', kind = '{camera}', width = {width}, height = {height}, every = {every},
              x = {x:.2f}, z = {z:.2f}, pitch_deg = {pitch:.0f} }},
        }} }}
        if not p.goal then wait(86400) end

        local goal = pick_lane{{ length = 50 }}
        local length = ego:route_to{{ lane = goal, s = 30 }}
        -- The goal may lie on the lane that we start from, behind us.
        wait_until(function()
            return ego:distance_driven() > length - 10 and ego:lane() == goal and ego:s() >= 30
        end)
        finish 'arrived'
    end,
}}
)lua";

/// Of the camera.
world::Viewpoint viewpoint_of(const DriveOptions& options) {
    const auto index = world::find_vehicle_model(options.model);
    REPRISE_CHECK(index.has_value(), options.model);
    const world::VehicleModel& model = world::vehicle_models()[*index];
    return options.place == "driver" ? world::drivers_eye(model)
                                     : world::chase(world::extent_of(model));
}

std::string scenario_text(const DriveOptions& options) {
    const world::Viewpoint view = viewpoint_of(options);
    // Words were looked up; the town's name, which is anything, goes in beside the text.
    return fmt::format(
        drive_text,
        fmt::arg("cars",
                 options.cars == world::auto_cars ? "'auto'" : fmt::format("{}", options.cars)),
        fmt::arg("walkers", options.walkers),
        fmt::arg("weather", options.weather),
        fmt::arg("goal", options.goal),
        fmt::arg("model", options.model),
        fmt::arg("latency", latency),
        fmt::arg("camera", options.camera),
        fmt::arg("width", options.width),
        fmt::arg("height", options.height),
        fmt::arg("every", options.every),
        fmt::arg("x", view.place.x()),
        fmt::arg("z", view.place.z()),
        fmt::arg("pitch", view.pitch * 180 / std::numbers::pi));
}

}  // namespace

int drive(const DriveOptions& options) {
    RunOptions run_options;
    run_options.scenario = "drive.lua";
    run_options.source = scenario_text(options);
    run_options.output = options.output;
    run_options.town = options.town;
    run_options.seed = options.seed;
    run_options.seconds = options.seconds;
    run_options.drivers = {"ego=" + wheel_command(options.wheel)};
    return run(run_options);
}

}  // namespace reprise::cli

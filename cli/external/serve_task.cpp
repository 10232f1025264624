#include "cli/external/serve_task.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "world/check.h"
#include "world/external/sensor.h"
#include "world/town.h"
#include "world/weather/weather_text.h"

namespace reprise::cli {

namespace {

constexpr unsigned most_cars = 10'000;
constexpr unsigned most_walkers = 2'000;
constexpr unsigned most_sensors = 16;  // as a rig has
constexpr unsigned most_attributes = 40;
constexpr std::size_t longest_word = 40;
constexpr std::uint64_t most_seed = std::numeric_limits<std::int64_t>::max();  // Lua's integers
constexpr std::string_view word_letters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";

/// A place as the parameters of the script have it: lane '' is drawn there.
struct NamedPlace {
    std::string lane;
    double s = 0;
};

constexpr const char* task_text =
    R"lua(-- A driver in another program goes from a place to a goal, within the time that the way takes at 10 km/h
-- (Dosovitskiy et al., CoRL 2017). Collisions and wrong lanes do not end it: they are in the measurements.
-- Lanes that are not named are chosen by the seed; without a goal it drives until the time limit.
return scenario 'task' {{
    town = '{town}', cars = {cars}{walkers}, weather = '{weather}', duration = 7200,
    params = {{ model = 'sedan', start = '', s = 10.0, with_goal = false, goal = '', goal_s = 30.0 }},

    run = function(p)
        local place = {{ name = 'ego', model = p.model, driver = 'external'{every}{rig} }}
        if p.start ~= '' then place.lane, place.s = p.start, p.s end
        local ego = spawn(place)
        if not p.with_goal then wait(7200) end

        local goal = p.goal ~= '' and p.goal or pick_lane{{ length = 50 }}
        local length = ego:route_to{{ lane = goal, s = p.goal_s }}
        -- The goal may lie on the lane that we start from, behind us.
        local function arrived()
            return ego:distance_driven() > length - 10 and ego:lane() == goal and ego:s() >= p.goal_s
        end
        check.eventually('arrived in time', arrived, {{ within = length / (10 / 3.6), stop = true }})
        wait_until(arrived)
        finish 'arrived'
    end,
}}
)lua";

NamedPlace named_place(const remote::Place& place, const world::TownT& town, const char* what) {
    switch (place.kind()) {
        case remote::PlaceKind::drawn:
            break;
        case remote::PlaceKind::lane: {
            const std::string name = place.lane() == nullptr ? "" : place.lane()->str();
            const auto lane = world::find_lane(town, name);
            if (!lane || town.lanes[*lane].kind != world::LaneKind::driving)
                throw world::Error(fmt::format(
                    "the task's {}: no lane for cars '{}' in {}", what, name, town.name));
            return {name, place.s()};
        }
        case remote::PlaceKind::spawn_point: {
            const auto index = place.spawn_point();
            if (index >= town.spawn_points.size() || town.spawn_points[index].for_walkers())
                throw world::Error(
                    fmt::format("the task's {}: {} has no spawn point {} for cars; there are {}",
                                what,
                                town.name,
                                index,
                                town.spawn_points.size()));
            const world::SpawnPoint& point = town.spawn_points[index];
            return {town.lanes.at(point.lane()).name, point.s()};
        }
    }
    return {};
}

std::string number_text(std::string_view key, double value) {
    if (!std::isfinite(value))
        throw world::Error(fmt::format("the task's rig: {} is no number", key));
    return fmt::format("{} = {}", key, value);
}

/// Words that end up in the text are checked: they may not end their quotes.
std::string_view word(const flatbuffers::String* text) {
    if (text == nullptr || text->size() == 0 || text->size() > longest_word ||
        text->string_view().find_first_not_of(word_letters) != std::string_view::npos)
        throw world::Error(
            "the task's rig: names and kinds have letters, digits, _ and -, at most 40 of them");
    return text->string_view();
}

/// `, attributes = { ... }` of a sensor.
std::string attributes_text(const remote::TaskSensor& sensor) {
    if (sensor.attributes() == nullptr || sensor.attributes()->size() == 0)
        return "";
    if (sensor.attributes()->size() > most_attributes)
        throw world::Error(
            fmt::format("the task's rig: at most {} attributes of a sensor", most_attributes));
    std::string text;
    for (const remote::TaskAttribute* one : *sensor.attributes())
        // In brackets, as a word of Lua's would be no key.
        text += number_text(fmt::format("['{}']", word(one->name())), one->value()) + ", ";
    return ", attributes = { " + text + "}";
}

/// What of a camera's view is not as usual: the message has numbers for others, too, whose words of
/// a scenario have none.
std::string view_text(const remote::TaskSensor& sensor) {
    constexpr double same = 1e-9;  // [deg]
    const world::SensorSpec usual;
    const double usual_fov = usual.fov * 180 / std::numbers::pi;
    std::string text;
    if (sensor.width() != static_cast<std::uint32_t>(usual.width))
        text += fmt::format(", width = {}", sensor.width());
    if (sensor.height() != static_cast<std::uint32_t>(usual.height))
        text += fmt::format(", height = {}", sensor.height());
    if (!(std::abs(sensor.fov_deg() - usual_fov) <= same))
        text += ", " + number_text("fov_deg", sensor.fov_deg());
    return text;
}

/// `, every = ...` of spawn or of a sensor.
std::string every_text(std::uint32_t every) {
    return every == 0 ? "" : fmt::format(", every = {}", every);
}

/// `, rig = { ... }` of spawn, in the scenario's words, which say what may be in it.
std::string rig_text(const remote::Task& task) {
    if (task.rig() == nullptr || task.rig()->size() == 0)
        return "";
    if (task.rig()->size() > most_sensors)
        throw world::Error(fmt::format("the task's rig: at most {} sensors", most_sensors));
    std::string text;
    for (const remote::TaskSensor* sensor : *task.rig()) {
        text +=
            fmt::format("{{ name = '{}', kind = '{}'", word(sensor->name()), word(sensor->kind()));
        text += every_text(sensor->every());
        text += view_text(*sensor);
        for (const auto& [key, value] : {std::pair("x", sensor->x()),
                                         std::pair("y", sensor->y()),
                                         std::pair("z", sensor->z()),
                                         std::pair("yaw_deg", sensor->yaw_deg()),
                                         std::pair("pitch_deg", sensor->pitch_deg()),
                                         std::pair("roll_deg", sensor->roll_deg())})
            text += ", " + number_text(key, value);
        text += attributes_text(*sensor) + " }, ";
    }
    return ", rig = { " + text + "}";
}

/// `, walkers = ...` of the header.
std::string walkers_text(const remote::Task& task) {
    if (task.walkers() == 0)
        return "";
    std::string text = fmt::format(", walkers = {}", task.walkers());
    if (task.walker_seeded())
        text += fmt::format(", walker_seed = {}", task.walker_seed());
    return text;
}

}  // namespace

TaskScenario scenario_of(const remote::Task& task, const world::TownT& town) {
    const std::string weather = task.weather() == nullptr || task.weather()->size() == 0
                                    ? "clear_noon"
                                    : task.weather()->str();
    try {
        world::read_weather(weather);
    } catch (const world::Error& error) {
        throw world::Error(fmt::format("the task's weather: {}", error.what()));
    }
    if (task.cars() > most_cars)
        throw world::Error(fmt::format("the task's cars: expected 0 to {}", most_cars));
    if (task.walkers() > most_walkers)
        throw world::Error(fmt::format("the task's walkers: expected 0 to {}", most_walkers));
    if (task.walker_seed() > most_seed)
        throw world::Error(fmt::format("the task's walker_seed: at most {}", most_seed));
    TaskScenario scenario;
    // Only names that were looked up go into the text; what a client wrote goes in as parameters.
    scenario.source =
        fmt::format(task_text,
                    fmt::arg("town", town.name),
                    fmt::arg("cars", task.cars()),
                    fmt::arg("walkers", walkers_text(task)),
                    fmt::arg("weather", weather),
                    fmt::arg("every", task.every() > 1 ? every_text(task.every()) : ""),
                    fmt::arg("rig", rig_text(task)));
    auto& parameters = scenario.overrides.parameters;
    if (task.model() != nullptr && task.model()->size() != 0)
        parameters.emplace_back("model", task.model()->str());
    if (task.start() != nullptr) {
        const NamedPlace start = named_place(*task.start(), town, "start");
        if (!start.lane.empty()) {
            parameters.emplace_back("start", start.lane);
            parameters.emplace_back("s", fmt::format("{}", start.s));
        }
    }
    if (task.goal() != nullptr) {
        parameters.emplace_back("with_goal", "true");
        const NamedPlace goal = named_place(*task.goal(), town, "goal");
        if (!goal.lane.empty()) {
            parameters.emplace_back("goal", goal.lane);
            parameters.emplace_back("goal_s", fmt::format("{}", goal.s));
        }
    }
    return scenario;
}

}  // namespace reprise::cli

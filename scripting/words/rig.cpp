#include "scripting/words/rig.h"

#include <algorithm>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"
#include "scripting/run/language.h"
#include "world/check.h"
#include "world/external/rig.h"
#include "world/external/sensor_attributes.h"
#include "world/story/wording.h"

// What a vehicle carries, and what its driver is shown.
namespace reprise::scripting {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t most_picture_bytes = std::size_t{2} << 30U;  // in memory at once, of a driver
const std::vector<std::string> sights{"everything", "sensors"};

double within(const Fields& fields, const char* key, double usual, double low, double high) {
    const double value = fields.number(key).value_or(usual);
    if (value < low || value > high)
        refuse(fields.who(),
               fmt::format(
                   "'{}' must be in [{:g}, {:g}], got {}", key, low, high, number_text(value)));
    return value;
}

std::int64_t whole_within(const Fields& fields,
                          const char* key,
                          std::int64_t usual,
                          std::int64_t low,
                          std::int64_t high) {
    const std::int64_t value = fields.integer(key).value_or(usual);
    if (value < low || value > high)
        refuse(fields.who(),
               fmt::format("'{}' must be in [{}, {}], got {}", key, low, high, value));
    return value;
}

constexpr Key sensor_key_rows[] = {
    {"name", "string", "letters, digits, _ and -; unique on the vehicle", true},
    {"kind",
     "'rgb'|'depth'|'semantic'|'instance'|'flow'|'normals'|'dvs'|'lidar'|'semantic_lidar'|'radar'|"
     "'gnss'|'imu'|'collision'|'lane_invasion'|'obstacle'",
     "default 'rgb'; docs/rendering.md and docs/sensors.md say what each is"},
    {"width", "integer", "[px] of cameras, 1 to 4096, default 800"},
    {"height", "integer", "[px] of cameras, 1 to 4096, default 600"},
    {"fov_deg", "number", "[deg] of cameras, 1 to 170 across, of a fisheye to 200; default 90"},
    {"x", "number", "[m] ahead of the rear axle, default 1"},
    {"y", "number", "[m] to the left, default 0"},
    {"z", "number", "[m] above the ground, default 1.4"},
    {"yaw_deg", "number", "[deg] to the left, default 0: ahead"},
    {"pitch_deg", "number", "[deg] up, default 0"},
    {"roll_deg", "number", "[deg] right side down, default 0"},
    {"every", "integer", "[ticks] between frames, default the vehicle's, which is 1"},
    {"attributes", "table", "of its kind, such as { lens = 'fisheye' }; see docs/rendering.md"},
};

double value_of_word(const Fields& fields, const world::AttributeRow& row) {
    try {
        return world::value_of_word(row, fields.text(std::string(row.name).c_str()).value_or(""));
    } catch (const world::WrongWord& wrong) {
        refuse(fields.who(), wrong.what());
    }
}

/// What the sensor is told that does not go together.
void refuse_contradiction(const Fields& fields, const world::SensorT& sensor) {
    world::SensorSpec spec;
    spec.kind = sensor.kind;
    spec.fov = sensor.fov;
    for (const auto& one : sensor.attributes)
        spec.attributes.push_back({one->name, one->value});
    if (const std::string why = world::contradiction(spec); !why.empty())
        refuse(fields.who(), why);
}

/// The table on top of the stack as attributes of the sensor, in the order of their names.
std::vector<std::unique_ptr<world::SensorAttributeT>> read_attributes(
    lua_State* L, const std::string& who, const world::SensorT& sensor) {
    const std::vector<std::string> names = world::attribute_names(sensor.kind);
    const Fields fields(L, -1, who + ": 'attributes'", names);
    std::vector<std::unique_ptr<world::SensorAttributeT>> attributes;
    for (const std::string& name : names) {
        if (!fields.mentions(name))
            continue;
        const world::AttributeRow& row = *world::find_attribute(sensor.kind, name);
        auto& one = attributes.emplace_back(std::make_unique<world::SensorAttributeT>());
        one->name = name;
        if (row.words.empty())
            one->value = within(fields, name.c_str(), row.usual, row.low, row.high);
        else
            one->value = value_of_word(fields, row);
    }
    return attributes;
}

/// What only cameras have.
void refuse_view(const Fields& fields, world::SensorKind kind) {
    if (world::is_camera(kind))
        return;
    for (const char* key : {"width", "height", "fov_deg"})
        if (fields.mentions(key))
            refuse(fields.who(),
                   fmt::format("'{}' is of cameras; what {} measures, its 'attributes' say",
                               key,
                               world::with_article(world::EnumNameSensorKind(kind))));
}

/// The table on top of the stack as the sensor with this number.
std::unique_ptr<world::SensorT> read_sensor(lua_State* L, std::size_t number, int shown_every) {
    const Fields fields(
        L, -1, fmt::format("spawn: sensor {} of 'rig'", number), names_of(sensor_key_rows));
    auto sensor = std::make_unique<world::SensorT>();
    const auto name = fields.text("name");
    if (!name)
        refuse(fields.who(), "'name' is missing");
    if (!world::is_sensor_name(*name))
        refuse(fields.who(),
               fmt::format("'name' must be 1 to {} letters, digits, '_' or '-', as it names a "
                           "folder, got '{}'",
                           world::longest_sensor_name,
                           printable(*name)));
    sensor->name = *name;
    const world::SensorSpec usual;
    const std::string kind = fields.text("kind").value_or(world::EnumNameSensorKind(usual.kind));
    const auto known = world::find_sensor_kind(kind);
    if (!known)
        refuse(fields.who(),
               fmt::format("no kind '{}'{}; there are {}",
                           kind,
                           world::did_you_mean(kind, world::sensor_kinds()),
                           fmt::join(world::sensor_kinds(), ", ")));
    sensor->kind = *known;
    refuse_view(fields, sensor->kind);
    const auto side = [&](const char* key, int pixels) {
        return static_cast<std::uint16_t>(
            whole_within(fields, key, pixels, 1, world::largest_picture_side));
    };
    sensor->width = side("width", usual.width);
    sensor->height = side("height", usual.height);
    sensor->fov =
        within(fields, "fov_deg", 90, world::narrowest_view_deg, world::widest_fisheye_deg) *
        degree;
    const auto place = [&](const char* key, double metres) {
        return within(fields, key, metres, -world::farthest_mount, world::farthest_mount);
    };
    sensor->position = {place("x", usual.position.x()),
                        place("y", usual.position.y()),
                        place("z", usual.position.z())};
    sensor->yaw = within(fields, "yaw_deg", 0, -360, 360) * degree;
    sensor->pitch = within(fields, "pitch_deg", 0, -90, 90) * degree;
    if (fields.mentions("roll_deg"))
        sensor->roll = within(fields, "roll_deg", 0, -360, 360) * degree;
    sensor->every = static_cast<std::uint32_t>(
        whole_within(fields, "every", shown_every, 1, world::longest_sensor_period));
    if (sensor->every % static_cast<std::uint32_t>(shown_every) != 0 &&
        !world::tells_what_happens(sensor->kind))
        refuse(fields.who(),
               fmt::format("'every' must be a multiple of the vehicle's, {}, or its driver would "
                           "not be shown every frame, got {}",
                           shown_every,
                           sensor->every));
    if (fields.mentions("attributes")) {
        fields.push("attributes");
        sensor->attributes = read_attributes(L, fields.who(), *sensor);
        lua_pop(L, 1);
    }
    refuse_contradiction(fields, *sensor);
    return sensor;
}

/// Entries of the list on top of the stack; refuses what is none.
std::size_t count_sensors(lua_State* L) {
    const std::string wanted = "'rig' must be a list of sensors { { name = 'front', ... }, ... }";
    if (lua_type(L, -1) != LUA_TTABLE)
        refuse("spawn", fmt::format("{}, got {}", wanted, luaL_typename(L, -1)));
    std::size_t entries = 0;
    for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1))
        ++entries;
    Vm::of(L).charge_walk(L, entries);
    const std::size_t length = lua_rawlen(L, -1);
    if (entries == 0 || entries != length)
        refuse("spawn", wanted);
    if (length > world::most_sensors)
        refuse(
            "spawn",
            fmt::format("'rig' has {} sensors, where {} is the most", length, world::most_sensors));
    return length;
}

/// [bytes] that a frame needs in memory, at most.
std::size_t bytes_of(const world::SensorT& sensor, double step) {
    world::SensorSpec spec;
    spec.kind = sensor.kind;
    spec.width = sensor.width;
    spec.height = sensor.height;
    spec.step = step;
    spec.every = sensor.every;
    for (const auto& one : sensor.attributes)
        spec.attributes.push_back({one->name, one->value});
    return world::frame_bytes(spec);
}

}  // namespace

constinit const KeyList sensor_keys{"SensorOptions", "rig of spawn", sensor_key_rows};

std::vector<std::unique_ptr<world::SensorT>> read_rig(
    lua_State* L, const Fields& spawn, const Actor& actor, const Rhythm& rhythm, double step) {
    std::vector<std::unique_ptr<world::SensorT>> rig;
    if (!spawn.mentions("rig"))
        return rig;
    if (!actor.is_driven() && actor.driver != world::Driver::external)
        refuse(
            "spawn",
            fmt::format("'rig' is for the drivers 'autopilot', 'manual' and 'external', '{}' has "
                        "another one",
                        actor.name));
    spawn.push("rig");
    const std::size_t length = count_sensors(L);
    std::size_t bytes = 0;
    for (std::size_t i = 1; i <= length; ++i) {
        lua_rawgeti(L, -1, static_cast<lua_Integer>(i));
        rig.push_back(read_sensor(L, i, rhythm.every));
        lua_pop(L, 1);
        bytes += bytes_of(*rig.back(), step);
        for (std::size_t other = 0; other + 1 < i; ++other)
            if (rig[other]->name == rig.back()->name)
                refuse("spawn",
                       fmt::format("sensors {} and {} of 'rig' are both named '{}'",
                                   other + 1,
                                   i,
                                   rig.back()->name));
    }
    lua_pop(L, 1);
    // As many are kept as a driver may still look at: remote/picture_ring.h.
    const std::size_t kept = bytes * (std::size_t{2} + rhythm.latency);
    if (kept > most_picture_bytes)
        refuse("spawn",
               fmt::format("the frames of 'rig' need {:.1f} GB of memory, where {:.1f} are the "
                           "most: smaller or fewer ones, or a smaller 'latency'",
                           static_cast<double>(kept) * 1e-9,
                           static_cast<double>(most_picture_bytes) * 1e-9));
    return rig;
}

bool read_sees_sensors(const Fields& spawn, const Actor& actor) {
    if (!spawn.mentions("sees"))
        return false;
    if (actor.driver != world::Driver::external)
        refuse("spawn",
               fmt::format("'sees' is for driver = 'external', '{}' is driven by Reprise",
                           actor.name));
    const std::string sight = spawn.text("sees").value_or(sights.front());
    if (std::find(sights.begin(), sights.end(), sight) == sights.end())
        refuse("spawn",
               fmt::format("'sees' must be 'everything' or 'sensors', got '{}'{}",
                           sight,
                           world::did_you_mean(sight, sights)));
    return sight == sights.back();
}

}  // namespace reprise::scripting

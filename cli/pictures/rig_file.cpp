#include "cli/pictures/rig_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/table/actor_search.h"
#include "world/check.h"
#include "world/external/sensor_attributes.h"
#include "world/story/wording.h"
#include "world/units.h"

namespace reprise::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr double farthest_place = 1e6;  // [m] in the world
constexpr std::size_t most_rig_sensors = 1000;

/// For a message of one line.
std::string shown(const Json& json) {
    constexpr std::size_t most = 60;
    std::string text = json.dump();
    if (text.size() <= most)
        return text;
    std::size_t end = most;
    while ((static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80)
        --end;  // not within a sign of several bytes
    return text.substr(0, end) + "...";
}

/// A JSON object whose keys are known, and where it is, for messages.
class Table {
  public:
    Table(const Json& json, std::string where, const std::vector<std::string>& known)
        : json_(json),
          where_(std::move(where)) {
        if (!json.is_object())
            refuse("expected { ... }, got " + shown(json));
        for (const auto& [key, value] : json.items())
            if (std::find(known.begin(), known.end(), key) == known.end())
                refuse(fmt::format("unknown key '{}'{}", key, world::did_you_mean(key, known)));
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw world::Error(where_ + ": " + why);
    }

    const Json* find(const std::string& key) const {
        const auto found = json_.find(key);
        return found == json_.end() ? nullptr : &*found;
    }

    std::optional<std::string> text(const std::string& key) const {
        const Json* value = find(key);
        if (value == nullptr)
            return std::nullopt;
        if (!value->is_string())
            refuse(fmt::format("'{}' must be a text, got {}", key, shown(*value)));
        return value->get<std::string>();
    }

    double number(const std::string& key, double usual, double low, double high) const {
        const Json* value = find(key);
        return value == nullptr ? usual : within(key, *value, low, high);
    }

    double within(const std::string& key, const Json& value, double low, double high) const {
        const double number = value.is_number() ? value.get<double>() : std::nan("");
        if (!(number >= low && number <= high))
            refuse(fmt::format(
                "'{}' must be a number in [{:g}, {:g}], got {}", key, low, high, shown(value)));
        return number;
    }

    std::int64_t whole(const std::string& key, const Json& value, std::int64_t high) const {
        const auto number = within(key, value, 1, static_cast<double>(high));
        if (number != std::floor(number))
            refuse(fmt::format("'{}' must be a whole number, got {}", key, shown(value)));
        return static_cast<std::int64_t>(number);
    }

    /// So many numbers in a row.
    const Json* list(const std::string& key, std::size_t length) const {
        const Json* value = find(key);
        if (value != nullptr && (!value->is_array() || value->size() != length))
            refuse(
                fmt::format("'{}' must be {} numbers [ ... ], got {}", key, length, shown(*value)));
        return value;
    }

  private:
    const Json& json_;
    std::string where_;
};

std::ptrdiff_t line_at(const std::string& text, std::size_t place) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(place, text.size()));
    return 1 + std::count(text.begin(), end, '\n');
}

/// Lines on which what is in the outermost list begins: of sound JSON whose only key is "sensors".
std::vector<std::ptrdiff_t> lines_of_sensors(const std::string& text) {
    std::vector<std::ptrdiff_t> lines;
    int depth = 0;
    bool quoted = false;
    bool begins = false;  // what comes is the first of a sensor
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char sign = text[i];
        if (std::string_view(" \t\r\n").find(sign) != std::string_view::npos)
            continue;
        if (!quoted && begins && sign != ']')
            lines.push_back(line_at(text, i));
        begins = !quoted && ((depth == 1 && sign == '[') || (depth == 2 && sign == ','));
        if (quoted && sign == '\\')
            ++i;
        else if (sign == '"')
            quoted = !quoted;
        else if (!quoted && (sign == '[' || sign == '{'))
            ++depth;
        else if (!quoted && (sign == ']' || sign == '}'))
            --depth;
    }
    return lines;
}

std::string read(const std::filesystem::path& path) {
    constexpr std::uintmax_t largest = 1 << 20;
    std::error_code error;
    // It is read again for the manifest, which a pipe could not be.
    if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
        throw world::Error(path.string() + ": is not a file, where a rig was expected");
    if (const auto size = std::filesystem::file_size(path, error); !error && size > largest)
        throw world::Error(path.string() + ": is larger than 1 MB: not a rig");
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    if (!file.is_open() || (file.peek() != EOF && !(bytes << file.rdbuf())) || file.bad())
        throw world::Error(path.string() + ": cannot be read");
    return std::move(bytes).str();
}

[[noreturn]] void refuse_as_no_json(const std::filesystem::path& path,
                                    const std::string& text,
                                    std::size_t place) {
    throw world::Error(
        fmt::format("{}:{}: this is no JSON, where {{ \"sensors\": [ ... ] }} was expected",
                    path.string(),
                    line_at(text, place)));
}

/// Refuses what says a key of an object twice: the last would count, and nobody is told.
Json parse(const std::filesystem::path& path, const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::set<std::string>> open;  // keys of the objects around here
    const auto hold = [&](int, Json::parse_event_t event, const Json& value) {
        if (event == Json::parse_event_t::object_start)
            open.emplace_back();
        else if (event == Json::parse_event_t::object_end)
            open.pop_back();
        else if (event == Json::parse_event_t::key && !open.back().insert(value).second)
            throw world::Error(fmt::format("{}:{}: '{}' is there twice",
                                           path.string(),
                                           line_at(text, static_cast<std::size_t>(stream.tellg())),
                                           value.get<std::string>()));
        return true;
    };
    // The parser takes it as the end, and would let anything follow.
    if (const std::size_t nul = text.find('\0'); nul != std::string::npos)
        refuse_as_no_json(path, text, nul);
    try {
        return Json::parse(stream, hold);
    } catch (const Json::parse_error& error) {
        refuse_as_no_json(path, text, error.byte);
    } catch (const Json::exception&) {
        // Its end shows where the next sign is.
        throw world::Error(
            fmt::format("{}:{}: a number is too large",
                        path.string(),
                        line_at(text, static_cast<std::size_t>(stream.tellg()) - 1)));
    }
}

std::uint32_t period_of(const Table& table, std::uint64_t step_ns) {
    const Json* every = table.find("every");
    const Json* rate = table.find("rate_hz");
    if (every != nullptr && rate != nullptr)
        table.refuse("'every' and 'rate_hz' say the same: one of them");
    if (every != nullptr)
        return static_cast<std::uint32_t>(
            table.whole("every", *every, world::longest_sensor_period));
    if (rate == nullptr)
        return 1;
    const double ticks_a_second = 1e9 / static_cast<double>(step_ns);
    const double ticks = ticks_a_second / table.within("rate_hz", *rate, 1e-3, ticks_a_second);
    if (std::abs(ticks - std::round(ticks)) > 1e-6 || ticks > world::longest_sensor_period)
        table.refuse(
            fmt::format("'rate_hz' must be {:g} over a whole number, as a tick is {:g} s, got {}",
                        ticks_a_second,
                        1 / ticks_a_second,
                        shown(*rate)));
    return static_cast<std::uint32_t>(std::lround(ticks));
}

const std::vector<std::string>& sensor_keys() {
    static const std::vector<std::string> keys{"name",
                                               "type",
                                               "actor",
                                               "position",
                                               "roll_deg",
                                               "pitch_deg",
                                               "yaw_deg",
                                               "fov_deg",
                                               "size",
                                               "every",
                                               "rate_hz",
                                               "attributes"};
    return keys;
}

/// A sensor's own key among its attributes, whose names may look like it.
void refuse_sensor_keys(const Json& json,
                        const std::string& where,
                        const std::vector<std::string>& names) {
    if (!json.is_object())
        return;
    for (const auto& [key, value] : json.items())
        for (const std::string& own : sensor_keys())
            if ((key == own || key + "_deg" == own) &&
                std::find(names.begin(), names.end(), key) == names.end())
                throw world::Error(fmt::format(
                    "{}: 'attributes': unknown key '{}' (did you mean '{}', beside 'attributes'?)",
                    where,
                    key,
                    own));
}

void read_attributes(const Json& json, const std::string& where, world::SensorSpec& sensor) {
    const std::vector<std::string> names = world::attribute_names(sensor.kind);
    refuse_sensor_keys(json, where, names);
    const Table table(json, where + ": 'attributes'", names);
    for (const std::string& name : names) {
        if (table.find(name) == nullptr)
            continue;
        const world::AttributeRow& row = *world::find_attribute(sensor.kind, name);
        if (row.words.empty()) {
            sensor.attributes.push_back({name, table.number(name, row.usual, row.low, row.high)});
            continue;
        }
        try {
            sensor.attributes.push_back({name, world::value_of_word(row, *table.text(name))});
        } catch (const world::WrongWord& wrong) {
            table.refuse(wrong.what());
        }
    }
}

/// What only cameras have.
void read_view(const Table& table, const std::string& type, world::SensorSpec& sensor) {
    if (!world::is_camera(sensor.kind)) {
        for (const char* key : {"fov_deg", "size"})
            if (table.find(key) != nullptr)
                table.refuse(
                    fmt::format("'{}' is of cameras; what {} measures, its 'attributes' say",
                                key,
                                world::with_article(type)));
        return;
    }
    sensor.fov = table.number("fov_deg", 90, world::narrowest_view_deg, world::widest_fisheye_deg) *
                 world::degree;
    if (const Json* size = table.list("size", 2)) {
        sensor.width =
            static_cast<int>(table.whole("size", (*size)[0], world::largest_picture_side));
        sensor.height =
            static_cast<int>(table.whole("size", (*size)[1], world::largest_picture_side));
    }
}

void read_sensor(const Json& json, const std::string& where, std::uint64_t step_ns, RigFile& file) {
    const Table table(json, where, sensor_keys());
    world::SensorSpec sensor;
    sensor.name = table.text("name").value_or("");
    if (!world::is_sensor_name(sensor.name))
        table.refuse(
            fmt::format("'name' must be 1 to {} letters, digits, '_' or '-', as it names a "
                        "folder",
                        world::longest_sensor_name));
    const std::string type = table.text("type").value_or("rgb");
    const auto kind = world::find_sensor_kind(type);
    if (!kind)
        table.refuse(fmt::format("no type '{}'{}; there are {}",
                                 type,
                                 world::did_you_mean(type, world::sensor_kinds()),
                                 fmt::join(world::sensor_kinds(), ", ")));
    sensor.kind = *kind;
    const std::string& carrier = file.carriers.emplace_back(table.text("actor").value_or(""));
    if (carrier.empty() && table.find("actor") != nullptr)
        table.refuse("'actor' is empty; without it the carrier is --actor, or the first vehicle");
    if (carrier == "world" && world::tells_what_happens(sensor.kind))
        table.refuse(fmt::format("{} tells what its 'actor' does, who cannot be the world",
                                 world::with_article(type)));
    const double reach = carrier == "world" ? farthest_place : world::farthest_mount;
    if (const Json* place = table.list("position", 3))
        for (int axis = 0; axis < 3; ++axis)
            sensor.position[axis] =
                table.within("position", (*place)[static_cast<std::size_t>(axis)], -reach, reach);
    sensor.roll = table.number("roll_deg", 0, -360, 360) * world::degree;
    sensor.pitch = table.number("pitch_deg", 0, -90, 90) * world::degree;
    sensor.yaw = table.number("yaw_deg", 0, -360, 360) * world::degree;
    read_view(table, type, sensor);
    if (const Json* attributes = table.find("attributes"))
        read_attributes(*attributes, where, sensor);
    if (const std::string why = world::contradiction(sensor); !why.empty())
        table.refuse(why);
    for (const world::SensorSpec& other : file.rig.sensors)
        if (other.name == sensor.name)
            table.refuse(fmt::format("an earlier sensor is named '{}' as well", sensor.name));
    file.rig.sensors.push_back(sensor);
    file.rig.every.push_back(period_of(table, step_ns));
}

/// 0: the world; none: who usually does.
std::optional<std::uint32_t> find_carrier(const std::string& name,
                                          const std::string& where,
                                          replay::TraceReader& trace) {
    if (name.empty())
        return std::nullopt;
    if (name == "world")
        return 0;
    try {
        return replay::find_actor(trace, name);
    } catch (const world::Error& error) {
        throw world::Error(where + ": " + error.what());
    }
}

}  // namespace

RigFile read_rig_file(const std::filesystem::path& path, replay::TraceReader& trace) {
    const std::string text = read(path);
    const Json json = parse(path, text);
    const Table table(json, path.string(), {"sensors"});
    const Json* sensors = table.find("sensors");
    if (sensors == nullptr || !sensors->is_array() || sensors->empty())
        table.refuse("expected { \"sensors\": [ { \"name\": \"front\" }, ... ] }");
    if (sensors->size() > most_rig_sensors)
        table.refuse(
            fmt::format("{} sensors, where {} is the most", sensors->size(), most_rig_sensors));
    RigFile file;
    std::vector<std::string> places;
    const std::vector<std::ptrdiff_t> lines = lines_of_sensors(text);
    REPRISE_CHECK(lines.size() >= sensors->size(), path.string());
    for (std::size_t i = 0; i < sensors->size(); ++i) {
        const Json& one = (*sensors)[i];
        const bool named = one.is_object() && one.contains("name") && one["name"].is_string() &&
                           world::is_sensor_name(one["name"].get<std::string>());
        places.push_back(fmt::format("{}:{}: sensor {}{}",
                                     path.string(),
                                     lines[i],
                                     i + 1,
                                     named ? " '" + one["name"].get<std::string>() + "'" : ""));
        read_sensor(one, places.back(), trace.episode().step_ns, file);
    }
    for (std::size_t i = 0; i < places.size(); ++i)
        file.carrier_ids.push_back(find_carrier(file.carriers[i], places[i], trace));
    return file;
}

RigFile only(RigFile file, bool cameras) {
    RigFile part;
    part.rig.since = file.rig.since;
    for (std::size_t i = 0; i < file.rig.sensors.size(); ++i) {
        if (world::is_camera(file.rig.sensors[i].kind) != cameras)
            continue;
        part.rig.sensors.push_back(std::move(file.rig.sensors[i]));
        part.rig.every.push_back(file.rig.every[i]);
        // Of a recorded rig all have one carrier.
        if (!file.carriers.empty()) {
            part.carriers.push_back(std::move(file.carriers[i]));
            part.carrier_ids.push_back(file.carrier_ids[i]);
        }
    }
    return part;
}

}  // namespace reprise::cli

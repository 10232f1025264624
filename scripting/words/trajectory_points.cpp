#include "scripting/words/trajectory_points.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/run/files.h"
#include "scripting/words/where.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/units.h"

namespace reprise::scripting {

namespace {

constexpr const char* follow_word = "follow";
constexpr std::size_t most_points = 20'000;
constexpr std::uint64_t byte_of_file_cost = 2;  // [instructions]
constexpr double farthest = 1e6;                // [m] from the origin

/// A point with x and y; the height is the road's, on the level of the one before.
SaidPoint point_at_xy(Run& run, lua_State* L, double time, double x, double y, double near) {
    SaidPoint point;
    point.time = time;
    if (std::abs(x) > farthest || std::abs(y) > farthest)
        refuse(follow_word, fmt::format("({}, {}) is nowhere", number_text(x), number_text(y)));
    point.p_world = {x, y, road_height(run, L, x, y, near).value_or(near)};
    return point;
}

// --- A list.

SaidPoint point_of_table(Run& run, lua_State* L, int index, const std::string& where, double near) {
    const Fields fields(L,
                        index,
                        fmt::format("{}: {}", follow_word, where),
                        {"t", "x", "y", "heading_deg", "lane", "s", "offset"});
    const auto time = fields.number("t");
    if (!time)
        refuse(fields.who(), "'t' is missing: { t = 2, x = 10, y = 3 }");
    const auto name = fields.text("lane");
    const auto x = fields.number("x");
    const auto y = fields.number("y");
    if (name ? x || y : !x || !y)
        refuse(fields.who(), "needs x and y, or lane, s and offset");
    if (!name && (fields.has("s") || fields.has("offset")))
        refuse(fields.who(), "'s' and 'offset' need a 'lane'");
    SaidPoint point;
    if (name) {
        const world::LaneT& lane = run.town.lanes[run.lane_named(L, *name)];
        const double s = fields.number("s").value_or(0);
        if (s < 0 || s > lane.length)
            refuse(fields.who(),
                   fmt::format("'s' must be in [0, {:.2f}], the length of '{}', got {}",
                               lane.length,
                               *name,
                               number_text(s)));
        const world::LanePoint at = world::point_at(lane, s);
        const double offset = fields.number("offset").value_or(0);
        point.time = *time;
        point.p_world =
            at.position + offset * Eigen::Vector3d(-std::sin(at.yaw), std::cos(at.yaw), 0);
    } else {
        point = point_at_xy(run, L, *time, *x, *y, near);
    }
    if (const auto heading = fields.number("heading_deg"))
        point.heading = *heading * world::degree;
    return point;
}

std::vector<SaidPoint> points_of_list(Run& run, lua_State* L, int index, double near) {
    std::vector<SaidPoint> points;
    const auto count = static_cast<lua_Integer>(lua_rawlen(L, index));
    if (count == 0)
        refuse(follow_word, "needs points: ego:follow{ { t = 2, x = 10, y = 3 }, { t = 4, ... } }");
    if (count > static_cast<lua_Integer>(most_points))
        refuse(follow_word, fmt::format("more than {} points", most_points));
    for (lua_Integer i = 1; i <= count; ++i) {
        run.vm.charge(L, 50);
        lua_rawgeti(L, index, i);
        const std::string where = fmt::format("point {}", i);
        if (lua_type(L, -1) != LUA_TTABLE)
            refuse(follow_word, where + " must be a table { t =, x =, y = }");
        points.push_back(point_of_table(run, L, lua_gettop(L), where, near));
        points.back().where = where;
        near = points.back().p_world.z();
        lua_pop(L, 1);
    }
    return points;
}

// --- A file.

const world::FileT& file_named(Run& run, const std::string& name) {
    if (!is_plain_name(name))
        refuse(follow_word,
               fmt::format("'{}' must be the plain name of a file beside the scenario, such as "
                           "'lead.csv'",
                           printable(name)));
    std::vector<std::string> names;
    for (const world::FileT& file : run.episode.files) {
        if (file.name == name)
            return file;
        names.push_back(file.name);
    }
    refuse(follow_word,
           fmt::format("no file '{}' came with the scenario{}: it must lie beside it, end in .csv, "
                       "and be named in the script or a parameter",
                       printable(name),
                       world::did_you_mean(name, names)));
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const std::size_t from = text.find_first_not_of(blanks);
    if (from == std::string_view::npos)
        return {};
    return text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t start = 0; start <= line.size();) {
        const std::size_t end = std::min(line.find(',', start), line.size());
        cells.push_back(trimmed(line.substr(start, end - start)));
        start = end + 1;
    }
    return cells;
}

/// Which column of a line holds what.
enum Column : std::size_t { column_t, column_x, column_y, column_heading, column_count };

const std::vector<std::string> column_names{"t", "x", "y", "heading_deg"};

[[noreturn]] void refuse_line(const std::string& where, const std::string& what) {
    refuse(follow_word, where + ": " + what);
}

std::vector<Column> columns_of(std::string_view line, const std::string& where) {
    std::vector<Column> columns;
    for (const std::string_view cell : cells_of(line)) {
        const auto known = std::find(column_names.begin(), column_names.end(), cell);
        if (known == column_names.end())
            refuse_line(where,
                        fmt::format("no column '{}'{}; the first line names the columns: t, x, y "
                                    "and, where it is known, heading_deg",
                                    printable(cell),
                                    world::did_you_mean(std::string(cell), column_names)));
        const auto column = static_cast<Column>(known - column_names.begin());
        if (std::find(columns.begin(), columns.end(), column) != columns.end())
            refuse_line(where, fmt::format("column '{}' twice", cell));
        columns.push_back(column);
    }
    for (const Column wanted : {column_t, column_x, column_y})
        if (std::find(columns.begin(), columns.end(), wanted) == columns.end())
            refuse_line(where, fmt::format("no column '{}'", column_names[wanted]));
    return columns;
}

double number_of(std::string_view cell, const std::string& where, Column column) {
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
        refuse_line(where,
                    fmt::format("'{}' must be a number, got '{}'",
                                column_names[column],
                                printable(cell.substr(0, 40))));
    return value;
}

SaidPoint point_of_line(Run& run,
                        lua_State* L,
                        std::string_view line,
                        const std::vector<Column>& columns,
                        const std::string& where,
                        double near) {
    const auto cells = cells_of(line);
    if (cells.size() != columns.size())
        refuse_line(where, fmt::format("{} values for {} columns", cells.size(), columns.size()));
    std::array<double, column_count> numbers{};
    bool has_heading = false;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (columns[i] == column_heading && cells[i].empty())
            continue;  // left out: from the way
        numbers[columns[i]] = number_of(cells[i], where, columns[i]);
        has_heading = has_heading || columns[i] == column_heading;
    }
    SaidPoint point =
        point_at_xy(run, L, numbers[column_t], numbers[column_x], numbers[column_y], near);
    if (has_heading)
        point.heading = numbers[column_heading] * world::degree;
    return point;
}

std::vector<SaidPoint> points_of_file(Run& run,
                                      lua_State* L,
                                      const std::string& name,
                                      double near) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    const world::FileT& file = file_named(run, name);
    run.vm.charge(L, byte_of_file_cost * file.text.size());
    std::string_view text = file.text;
    if (text.starts_with(byte_order_mark))
        text.remove_prefix(byte_order_mark.size());
    std::vector<Column> columns;
    std::vector<SaidPoint> points;
    std::size_t number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        const std::string where = fmt::format("{}:{}", name, ++number);
        if (line.empty())
            continue;
        if (columns.empty()) {
            columns = columns_of(line, where);
            continue;
        }
        if (points.size() >= most_points)
            refuse_line(where, fmt::format("more than {} points", most_points));
        points.push_back(point_of_line(run, L, line, columns, where, near));
        points.back().where = where;
        near = points.back().p_world.z();
    }
    if (points.empty())
        refuse_line(name, columns.empty() ? "is empty" : "holds no point");
    return points;
}

}  // namespace

std::vector<SaidPoint> read_points(Run& run, lua_State* L, int index, double near) {
    std::vector<SaidPoint> points;
    if (lua_type(L, index) == LUA_TSTRING)
        points = points_of_file(run, L, text_at(L, index, follow_word, "the file"), near);
    else if (lua_type(L, index) == LUA_TTABLE)
        points = points_of_list(run, L, index, near);
    else
        refuse(
            follow_word,
            fmt::format("needs a list of points, the name of a file or false, got {}: ego:follow{{ "
                        "{{ t = 2, x = 10, y = 3 }}, ... }}",
                        luaL_typename(L, index)));
    for (std::size_t i = 1; i < points.size(); ++i)
        if (!(points[i].time > points[i - 1].time))
            refuse(follow_word,
                   fmt::format("{}: t = {} is not later than t = {} of {}",
                               points[i].where,
                               number_text(points[i].time),
                               number_text(points[i - 1].time),
                               points[i - 1].where));
    return points;
}

}  // namespace reprise::scripting

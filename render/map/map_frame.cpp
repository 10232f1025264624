#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "render/map/map_layers.h"

namespace reprise::render {

namespace {

constexpr std::size_t entries_a_row = 7;
constexpr Ink pale{120, 124, 130};

/// Signs, plots and the like: does the town have any that `is_it` says yes to?
template <typename Things, typename Question>
bool any(const Things& things, Question&& is_it) {
    return std::any_of(things.begin(), things.end(), is_it);
}

double drivable_km(const world::TownT& town) {
    double metres = 0;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving)
            metres += lane.length;
    return metres / 1000;
}

std::string counts_of(const world::TownT& town) {
    std::size_t lit = 0;
    for (const world::JunctionT& junction : town.junctions)
        lit += junction.lit ? 1 : 0;
    std::size_t vehicles = 0;
    for (const world::SpawnPoint& point : town.spawn_points)
        vehicles += point.for_walkers() ? 0 : 1;
    std::string text = fmt::format("{:.2f} km of driving lanes, {} junctions ({} lit)",
                                   drivable_km(town),
                                   town.junctions.size(),
                                   lit);
    const auto add = [&](std::size_t count, const char* what) {
        if (count > 0)
            text += fmt::format(", {} {}", count, what);
    };
    add(town.buildings.size() + town.drawn_buildings.size(), "buildings");
    add(town.trees.size(), "plants");
    add(vehicles, "spawn points for vehicles");
    add(town.spawn_points.size() - vehicles, "for walkers");
    return text;
}

void draw_legend_shape(const LegendEntry& entry, double x, double y, MapCanvas& canvas) {
    const double u = canvas.unit();
    switch (entry.shape) {
        case LegendEntry::Shape::area:
            canvas.box(x, y - 6 * u, 22 * u, 12 * u, entry.ink);
            break;
        case LegendEntry::Shape::disc:
            canvas.dot(x + 11 * u, y, 7 * u, entry.ink.times(0.86));
            canvas.dot(x + 10 * u, y - u, 5.3 * u, entry.ink.times(1.06));
            break;
        case LegendEntry::Shape::arrow:
            canvas.box(x, y - 6 * u, 22 * u, 12 * u, road_ink(13.9));
            canvas.polygon(
                {{x + 16 * u, y}, {x + 6 * u, y - 4 * u}, {x + 9 * u, y}, {x + 6 * u, y + 4 * u}},
                entry.ink);
            break;
        case LegendEntry::Shape::signal:
            canvas.box(x + u, y - 4 * u, 20 * u, 8 * u, {36, 38, 42});
            canvas.dot(x + 5 * u, y, 2.7 * u, {228, 60, 50});
            canvas.dot(x + 11 * u, y, 2.7 * u, {240, 190, 50});
            canvas.dot(x + 17 * u, y, 2.7 * u, {60, 180, 90});
            break;
        case LegendEntry::Shape::car:
            canvas.polygon({{x + 18 * u, y}, {x + 6 * u, y - 5 * u}, {x + 6 * u, y + 5 * u}},
                           entry.ink);
            break;
        case LegendEntry::Shape::walker:
            canvas.dot(x + 11 * u, y, 3 * u, entry.ink);
            break;
        case LegendEntry::Shape::sign:
            canvas.dot(x + 11 * u, y, 6 * u, entry.ink);
            canvas.dot(x + 11 * u, y, 3.8 * u, white);
            break;
    }
}

void draw_legend(const std::vector<LegendEntry>& legend, MapCanvas& canvas) {
    const double u = canvas.unit();
    const double left = 24 * u;
    const double column = (canvas.width() - 2 * left) / static_cast<double>(entries_a_row);
    const double top = canvas.map().y + canvas.map().height + 22 * u;
    for (std::size_t i = 0; i < legend.size(); ++i) {
        const double x = left + column * static_cast<double>(i % entries_a_row);
        const std::size_t row = i / entries_a_row;
        const double y = top + 27 * u * static_cast<double>(row);
        draw_legend_shape(legend[i], x, y, canvas);
        canvas.write(legend[i].text, x + 30 * u, y + 4.5 * u, 9.5 * u, letters);
    }
}

/// Of 1, 2 or 5 times a power of ten metres, as long as an eighth of the map at most.
double round_length(double metres) {
    const double power = std::pow(10.0, std::floor(std::log10(metres)));
    for (const double factor : {5.0, 2.0})
        if (factor * power <= metres)
            return factor * power;
    return power;
}

void draw_scale(MapCanvas& canvas) {
    const double u = canvas.unit();
    const cv::Rect2d map = canvas.map();
    const double metres = round_length(0.16 * map.width / canvas.pixels_per_metre());
    const double length = metres * canvas.pixels_per_metre();
    const double x = canvas.width() - 24 * u - length;
    const double y = 36 * u;
    canvas.box(x, y, length, 7 * u, letters);
    canvas.box(x + length / 2, y + 1.2 * u, length / 2 - 1.2 * u, 4.6 * u, white);
    const std::string text =
        metres >= 1000 ? fmt::format("{:.0f} km", metres / 1000) : fmt::format("{:g} m", metres);
    canvas.write("0", x - 3 * u, y - 6 * u, 9 * u, letters);
    canvas.write(text, x + length - canvas.text_width(text, 9 * u), y - 6 * u, 9 * u, letters);
    // North is up.
    const double n = x - 38 * u;
    canvas.polygon({{n, 12 * u}, {n + 9 * u, 46 * u}, {n, 39 * u}}, letters);
    canvas.polygon({{n, 12 * u}, {n - 9 * u, 46 * u}, {n, 39 * u}}, pale);
    canvas.write("N", n + 12 * u, 24 * u, 11 * u, letters, true);
}

}  // namespace

std::vector<LegendEntry> legend_of(const world::TownT& town) {
    using Shape = LegendEntry::Shape;
    std::vector<LegendEntry> legend;
    const auto add_road = [&](double from_kmh, double to_kmh, const char* text) {
        if (any(town.lanes, [&](const world::LaneT& lane) {
                const double kmh = lane.speed_limit * 3.6;
                return lane.kind == world::LaneKind::driving && kmh >= from_kmh && kmh < to_kmh;
            }))
            legend.push_back({Shape::area, road_ink((from_kmh + to_kmh) / 2 / 3.6), text});
    };
    add_road(0, 35, "up to 30 km/h");
    add_road(35, 62, "up to 60 km/h");
    add_road(62, 1000, "above 60 km/h");
    if (any(town.lanes, [](const world::LaneT& lane) {
            return lane.kind == world::LaneKind::other && !lane.edge.starts_with(':');
        }))
        legend.push_back({Shape::area, {164, 138, 128}, "not for cars"});
    legend.push_back({Shape::arrow, {226, 229, 233}, "lane direction"});
    legend.push_back({Shape::area, {216, 209, 196}, "sidewalk"});
    if (!town.buildings.empty() || !town.drawn_buildings.empty())
        legend.push_back({Shape::area, {203, 158, 134}, "building"});
    if (!town.trees.empty())
        legend.push_back({Shape::disc, {122, 168, 98}, "plant"});
    if (!town.signals.empty())
        legend.push_back({Shape::signal, {}, "signal"});
    if (any(town.props,
            [](const world::Prop& prop) { return prop.kind() <= world::PropKind::yield_sign; }))
        legend.push_back({Shape::sign, {200, 40, 44}, "sign"});
    if (any(town.spawn_points, [](const auto& point) { return !point.for_walkers(); }))
        legend.push_back({Shape::car, {40, 96, 200}, "vehicles start"});
    if (any(town.spawn_points, [](const auto& point) { return point.for_walkers(); }))
        legend.push_back({Shape::walker, {226, 120, 40}, "walkers start"});
    for (const world::PlotKind kind : world::EnumValuesPlotKind()) {
        std::string name = world::EnumNamePlotKind(kind);
        std::replace(name.begin(), name.end(), '_', ' ');
        if (any(town.plots, [&](const world::PlotT& plot) { return plot.kind == kind; }))
            legend.push_back({Shape::area, plot_ink(kind), name});
    }
    return legend;
}

int legend_rows(const std::vector<LegendEntry>& legend) {
    return static_cast<int>((legend.size() + entries_a_row - 1) / entries_a_row);
}

void draw_frame(const world::TownT& town,
                const std::vector<LegendEntry>& legend,
                MapCanvas& canvas) {
    const double u = canvas.unit();
    canvas.write(town.name, 24 * u, 30 * u, 18 * u, letters, true);
    canvas.write(counts_of(town), 24 * u, 50 * u, 10 * u, pale);
    draw_scale(canvas);
    draw_legend(legend, canvas);
}

}  // namespace reprise::render

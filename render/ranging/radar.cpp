// What it must do: say which detections a radar of 77 GHz makes.
// What it assumes: surfaces are made of facets smaller than a beam, whose powers add up.
// How it goes:
//   1. rays on a grid over the field of view, each of which stands for its solid angle;
//   2. what each meets has a cross section, a range and a speed along the ray;
//   3. what lies in one cell of range, speed and angles is one target: powers add up, places are
//      means by power;
//   4. targets above the noise, with the errors that their strength leaves, the strongest first.
// What it keeps: nothing.
#include "render/ranging/radar.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/ranging/mount.h"
#include "render/ranging/point_frame.h"
#include "render/ranging/radar_link.h"
#include "render/ranging/reflectance.h"
#include "render/trace/default_float_mode.h"
#include "world/external/point_fields.h"
#include "world/external/sensor_attributes.h"
#include "world/external/sensor_noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

/// Of a ray's end.
struct Facet {
    double ratio;  ///< signal to noise
    double cross_section;
    double range;
    double speed;
    double azimuth;
    double altitude;
};

/// Sums, weighted by `ratio`.
struct Target {
    double ratio = 0;
    double cross_section = 0;
    double range = 0;
    double speed = 0;
    double azimuth = 0;
    double altitude = 0;
};

using Cell = std::tuple<int, int, int, int>;

/// A grid of directions, row by row from above, each from the left.
struct Grid {
    Grid(const world::SensorSpec& spec)
        : width(world::attribute(spec, "horizontal_fov") * degree),
          height(world::attribute(spec, "vertical_fov") * degree),
          spacing(world::attribute(spec, "ray_spacing") * degree),
          columns(std::max<std::size_t>(1, static_cast<std::size_t>(width / spacing))),
          rows(std::max<std::size_t>(1, static_cast<std::size_t>(height / spacing))) {}

    double azimuth(std::size_t column) const {
        return width * (0.5 - (static_cast<double>(column) + 0.5) / static_cast<double>(columns));
    }

    double altitude(std::size_t row) const {
        return height * (0.5 - (static_cast<double>(row) + 0.5) / static_cast<double>(rows));
    }

    /// [sr] that a ray stands for.
    double solid_angle(double altitude) const {
        return width / static_cast<double>(columns) * height / static_cast<double>(rows) *
               std::cos(altitude);
    }

    double width;
    double height;
    double spacing;
    std::size_t columns;
    std::size_t rows;
};

class Radar {
  public:
    Radar(const Scene& scene,
          const world::TickView& tick,
          const world::SensorSpec& spec,
          const world::Weather& weather,
          const Mount& mount)
        : scene_(scene),
          tick_(tick),
          grid_(spec),
          pose_(mount.pose()),
          velocity_(mount.velocity()),
          range_(world::attribute(spec, "range")),
          loss_(world::attribute(spec, "weather") >= 0.5
                    ? rain_loss(static_cast<double>(weather.rain()))
                    : 0),
          mask_(scene.mask_hiding(mount.hidden())) {}

    std::vector<std::vector<Facet>> facets() const {
        std::vector<std::vector<Facet>> found(grid_.rows);
        tbb::parallel_for(std::size_t{0}, grid_.rows, [&](std::size_t row) {
            const DefaultFloatMode plain;
            trace_row(row, found[row]);
        });
        return found;
    }

  private:
    void trace_row(std::size_t row, std::vector<Facet>& found) const {
        const double altitude = grid_.altitude(row);
        std::vector<Beam> beams;
        for (std::size_t column = 0; column < grid_.columns; ++column) {
            const double azimuth = grid_.azimuth(column);
            beams.push_back({pose_.translation(),
                             pose_.linear() * Vector3d(std::cos(altitude) * std::cos(azimuth),
                                                       std::cos(altitude) * std::sin(azimuth),
                                                       std::sin(altitude))});
        }
        std::vector<Echo> echoes(beams.size());
        find_echoes(scene_, beams, range_, mask_, echoes);
        for (std::size_t column = 0; column < grid_.columns; ++column)
            if (echoes[column] && echoes[column].distance > 0.1)
                found.push_back(
                    facet(echoes[column], beams[column], grid_.azimuth(column), altitude));
    }

    Facet facet(const Echo& echo, const Beam& beam, double azimuth, double altitude) const {
        // Lambert's facets: of the beam's area so much comes back as of a mirror of that share.
        const double area = echo.distance * echo.distance * grid_.solid_angle(altitude);
        const double cross_section = static_cast<double>(radar_share(scene_, echo)) * area *
                                     static_cast<double>(echo.cosine);
        const double gain =
            antenna_gain(azimuth, grid_.width) * antenna_gain(altitude, grid_.height);
        Vector3d velocity = Vector3d::Zero();
        if (echo.instance->actor != 0)
            if (const auto twist = find_twist(tick_, echo.instance->actor))
                velocity = twist->velocity_at(beam.origin + echo.distance * beam.direction +
                                              scene_.origin());
        return {signal_to_noise(cross_section, echo.distance, gain, loss_),
                cross_section,
                echo.distance,
                (velocity - velocity_).dot(beam.direction),
                azimuth,
                altitude};
    }

    const Scene& scene_;
    const world::TickView& tick_;
    Grid grid_;
    Eigen::Isometry3d pose_;
    Vector3d velocity_;
    double range_;
    double loss_;
    std::uint32_t mask_;
};

std::map<Cell, Target> targets_of(const std::vector<std::vector<Facet>>& facets,
                                  const world::SensorSpec& spec) {
    const double range_cell = world::attribute(spec, "range_cell");
    const double speed_cell = world::attribute(spec, "speed_cell");
    const double angle_cell = world::attribute(spec, "angle_cell") * degree;
    const auto number = [](double value, double cell) {
        return static_cast<int>(std::floor(value / cell));
    };
    std::map<Cell, Target> targets;
    for (const std::vector<Facet>& row : facets)
        for (const Facet& one : row) {
            Target& target = targets[{number(one.range, range_cell),
                                      number(one.speed, speed_cell),
                                      number(one.azimuth, angle_cell),
                                      number(one.altitude, angle_cell)}];
            target.ratio += one.ratio;
            target.cross_section += one.cross_section;
            target.range += one.ratio * one.range;
            target.speed += one.ratio * one.speed;
            target.azimuth += one.ratio * one.azimuth;
            target.altitude += one.ratio * one.altitude;
        }
    return targets;
}

/// Means instead of sums, the strongest first; equals in the order of their cells.
std::vector<Target> noticed(const std::map<Cell, Target>& targets) {
    std::vector<Target> found;
    for (const auto& [cell, sum] : targets)
        if (sum.ratio >= detection_ratio)
            found.push_back({sum.ratio,
                             sum.cross_section,
                             sum.range / sum.ratio,
                             sum.speed / sum.ratio,
                             sum.azimuth / sum.ratio,
                             sum.altitude / sum.ratio});
    std::stable_sort(found.begin(), found.end(), [](const Target& left, const Target& right) {
        return left.ratio > right.ratio;
    });
    return found;
}

double decibel(double ratio) {
    return 10 * std::log10(ratio);
}

}  // namespace

world::SensorFrame radar_frame(Scene& scene,
                               const world::TickView& tick,
                               const world::SensorSpec& spec,
                               const world::Weather& weather) {
    const Mount mount(tick, spec, scene.origin());
    const std::uint32_t hidden = mount.hidden();
    scene.place(tick, std::span(&hidden, hidden != 0 ? 1U : 0U));
    const Radar radar(scene, tick, spec, weather, mount);
    std::vector<Target> found = noticed(targets_of(radar.facets(), spec));
    const double time = spec.step * static_cast<double>(spec.every);
    const auto most =
        static_cast<std::size_t>(std::max(1.0, world::attribute(spec, "points_per_second") * time));
    if (found.size() > most)
        found.resize(most);

    const world::SensorNoise noise(
        static_cast<std::uint64_t>(world::attribute(spec, "noise_seed")), spec.name, tick.index());
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const Target& target = found[i];
        // Cells are measured into as finely as the signal stands out.
        const double spread = 1 / std::sqrt(2 * target.ratio);
        const auto measured = [&](double value, double cell, std::uint32_t which) {
            return value + cell * spread * noise.normal(i, which);
        };
        const double angle_cell = world::attribute(spec, "angle_cell") * degree;
        for (const double value : {measured(target.speed, world::attribute(spec, "speed_cell"), 0),
                                   measured(target.azimuth, angle_cell, 1),
                                   measured(target.altitude, angle_cell, 2),
                                   measured(target.range, world::attribute(spec, "range_cell"), 3),
                                   decibel(target.ratio),
                                   decibel(target.cross_section)})
            words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
    }
    return point_frame(tick, spec, words);
}

}  // namespace reprise::render

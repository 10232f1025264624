// What it must do: fill a frame of up to some hundred thousand points in some 20 ms of a core.
// What it assumes: the tick is all there is; neighbours in azimuth are neighbours in the scene.
// How it goes: a sweep's columns fall into moments of 10 ms, for each of which everybody is placed
//   where they were; the sensor itself moves from column to column. Blocks of 8 columns are traced
//   together, channel by channel: packets of rays that run alike. Points are gathered by block, so
//   that their order does not depend on threads.
// What it keeps: nothing.
#include "render/ranging/lidar.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/look/look.h"
#include "render/ranging/lidar_shot.h"
#include "render/ranging/mount.h"
#include "render/ranging/point_frame.h"
#include "render/ranging/sweep.h"
#include "render/trace/default_float_mode.h"
#include "world/external/point_fields.h"
#include "world/external/sensor_attributes.h"
#include "world/external/sensor_noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

constexpr std::size_t block = 8;  // columns: a packet of rays for each channel
constexpr double moment = 0.01;   // [s] in which nobody but the sensor moves

/// What all blocks read.
struct Work {
    const Scene& scene;
    const world::SensorSpec& spec;
    const Mount& mount;
    const LidarOptics* optics;  ///< none: semantic
    const world::SensorNoise& noise;
    double range;
    bool rolls;
    std::uint32_t mask;
    const std::vector<Eigen::Vector2d>& elevations;  ///< cosine, sine
    std::size_t rays;                                ///< of a shot
};

using Words = std::vector<std::uint32_t>;

std::uint32_t word(double value) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

/// Takes from ray to ray of one block what they have in common.
class Block {
  public:
    Block(const Work& work, std::span<const Sweep::Column> columns)
        : work_(work),
          columns_(columns) {
        for (const Sweep::Column& column : columns) {
            poses_.push_back(work.mount.pose(work.rolls ? column.ago : 0));
            azimuths_.emplace_back(std::cos(column.azimuth), std::sin(column.azimuth));
        }
    }

    Words trace() {
        const std::size_t shots = columns_.size() * work_.elevations.size();
        beams_.reserve(shots * work_.rays);
        for (std::size_t ray = 0; ray < work_.rays; ++ray)
            for (std::size_t ring = 0; ring < work_.elevations.size(); ++ring)
                for (std::size_t i = 0; i < columns_.size(); ++i)
                    beams_.push_back(
                        {poses_[i].translation(), poses_[i].linear() * direction(i, ring, ray)});
        echoes_.resize(beams_.size());
        find_echoes(work_.scene, beams_, work_.range, work_.mask, echoes_);
        const std::size_t most = work_.optics != nullptr ? work_.optics->returns : 1;
        Words words(shots * most * world::point_fields(work_.spec.kind).size());
        std::uint32_t* end = words.data();
        for (std::size_t i = 0; i < columns_.size(); ++i)
            for (std::size_t ring = 0; ring < work_.elevations.size(); ++ring)
                end = work_.optics != nullptr ? measure(end, i, ring) : label(end, i, ring);
        words.resize(static_cast<std::size_t>(end - words.data()));
        return words;
    }

  private:
    /// In the sensor's frame. Rays around the beam's middle stand where half of its light is
    /// inside.
    Vector3d direction(std::size_t column, std::size_t ring, std::size_t ray) const {
        const Eigen::Vector2d& up = work_.elevations[ring];
        const Eigen::Vector2d& turn = azimuths_[column];
        const Vector3d middle(up.x() * turn.x(), up.x() * turn.y(), up.y());
        if (ray == 0)
            return middle;
        const double away = 0.35 * work_.optics->divergence * (ray % 2 == 0 ? 1 : -1);
        const Vector3d left(-turn.y(), turn.x(), 0);
        return (middle + away * (ray < 3 ? left : middle.cross(left))).normalized();
    }

    std::size_t index(std::size_t column, std::size_t ring, std::size_t ray) const {
        return (ray * work_.elevations.size() + ring) * columns_.size() + column;
    }

    /// All of these write rows at `to`, and say where the next one goes.
    std::uint32_t* put_place(std::uint32_t* to,
                             std::size_t column,
                             std::size_t ring,
                             double range) const {
        const Vector3d p_sensor = range * direction(column, ring, 0);
        for (int axis = 0; axis < 3; ++axis)
            *to++ = word(p_sensor[axis]);
        return to;
    }

    std::uint32_t* measure(std::uint32_t* to, std::size_t column, std::size_t ring) {
        const std::uint64_t shot = columns_[column].number * work_.elevations.size() + ring;
        if (work_.optics->dropoff_general > 0 &&
            work_.noise.uniform(shot, 0) < work_.optics->dropoff_general)
            return to;
        std::span<const Echo> rays(&echoes_[index(column, ring, 0)], 1);
        if (work_.rays > 1) {
            for (std::size_t ray = 0; ray < work_.rays; ++ray)
                several_[ray] = echoes_[index(column, ring, ray)];
            rays = std::span(several_).first(work_.rays);
        }
        const LidarReturns returns =
            returns_of(*work_.optics, work_.scene, rays, work_.noise, shot);
        for (std::size_t i = 0; i < returns.count; ++i) {
            to = put_place(to, column, ring, returns.found[i].range);
            *to++ = word(static_cast<double>(returns.found[i].intensity));
            *to++ = word(-columns_[column].ago);
            *to++ = static_cast<std::uint32_t>(ring);
            *to++ = static_cast<std::uint32_t>(i);
        }
        return to;
    }

    std::uint32_t* label(std::uint32_t* to, std::size_t column, std::size_t ring) const {
        const Echo& echo = echoes_[index(column, ring, 0)];
        if (!echo)
            return to;
        to = put_place(to, column, ring, echo.distance);
        *to++ = word(static_cast<double>(echo.cosine));
        *to++ = echo.instance->actor;
        *to++ = static_cast<std::uint32_t>(semantic_class(work_.scene, echo.hit));
        *to++ = word(-columns_[column].ago);
        *to++ = static_cast<std::uint32_t>(ring);
        return to;
    }

    const Work& work_;
    std::span<const Sweep::Column> columns_;
    std::vector<Eigen::Isometry3d> poses_;
    std::vector<Eigen::Vector2d> azimuths_;
    std::vector<Beam> beams_;
    std::vector<Echo> echoes_;
    std::array<Echo, rays_of_wide_beam> several_;  ///< of one shot
};

void trace_moment(const Work& work,
                  std::span<const Sweep::Column> columns,
                  std::vector<Words>& all) {
    const std::size_t before = all.size();
    all.resize(before + (columns.size() + block - 1) / block);
    tbb::parallel_for(std::size_t{0}, all.size() - before, [&](std::size_t i) {
        const DefaultFloatMode plain;
        const std::size_t first = i * block;
        all[before + i] =
            Block(work, columns.subspan(first, std::min(block, columns.size() - first))).trace();
    });
}

/// Columns whose time lies in the same 10 ms before the tick.
struct Moment {
    double ago = 0;  ///< [s] its middle; 0 where nothing rolls
    std::span<const Sweep::Column> columns;
};

int moment_of(const Sweep::Column& column, bool rolls) {
    return rolls ? static_cast<int>(column.ago / moment) : 0;
}

std::vector<Moment> moments_of(std::span<const Sweep::Column> columns, bool rolls) {
    std::vector<Moment> moments;
    for (std::size_t first = 0; first < columns.size();) {
        const int now = moment_of(columns[first], rolls);
        std::size_t next = first;
        while (next < columns.size() && moment_of(columns[next], rolls) == now)
            ++next;
        // The first column of a moment was shot when the last one of the moment before it was.
        moments.push_back({rolls ? (now + 0.5) * moment : 0, columns.subspan(first, next - first)});
        first = next;
    }
    return moments;
}

/// Around all that the shots of a moment can meet.
Ball ball_of(const Moment& one, const Mount& mount, bool rolls, double range) {
    const Vector3d from = mount.pose(rolls ? one.columns.front().ago : 0).translation();
    const Vector3d to = mount.pose(rolls ? one.columns.back().ago : 0).translation();
    constexpr double rounding = 0.1;  // [m] and what a turn bends the way
    return {from, range + (to - from).norm() + rounding};
}

}  // namespace

world::SensorFrame lidar_frame(Scene& scene,
                               const world::TickView& tick,
                               const world::SensorSpec& spec,
                               const world::Weather& weather) {
    const Mount mount(tick, spec, scene.origin());
    const Sweep sweep = sweep_of(spec, tick.index());
    const bool semantic = spec.kind == world::SensorKind::semantic_lidar;
    std::optional<LidarOptics> optics;
    if (!semantic)
        optics.emplace(spec, weather);
    const world::SensorNoise noise(
        static_cast<std::uint64_t>(world::attribute(spec, "noise_seed")), spec.name, tick.index());
    std::vector<Eigen::Vector2d> elevations;
    for (const double elevation : sweep.elevations)
        elevations.emplace_back(std::cos(elevation), std::sin(elevation));
    const bool rolls = world::attribute(spec, "rolling") >= 0.5;
    const double range = world::attribute(spec, "range");
    const std::uint32_t hidden = mount.hidden();
    const std::span<const std::uint32_t> mounts(&hidden, hidden != 0 ? 1 : 0);

    const std::vector<Moment> moments = moments_of(sweep.columns, rolls);
    std::vector<Scene::Moment> places;
    for (const Moment& one : moments)
        places.push_back({one.ago, ball_of(one, mount, rolls, range)});
    std::vector<Words> found;  // by block
    scene.place_each(tick, mounts, places, [&](std::size_t i) {
        const Work work{scene,
                        spec,
                        mount,
                        optics ? &*optics : nullptr,
                        noise,
                        range,
                        rolls,
                        scene.mask_hiding(hidden),
                        elevations,
                        optics && optics->returns > 1 ? rays_of_wide_beam : 1};
        trace_moment(work, moments[i].columns, found);
    });
    return joined_point_frame(tick, spec, found);
}

}  // namespace reprise::render

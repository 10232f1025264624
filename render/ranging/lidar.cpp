// What it must do: fill a frame of up to some hundred thousand points in some 20 ms of a core.
// What it assumes: the tick is all there is; neighbours in azimuth are neighbours in the scene.
// How it goes: a sweep's columns fall into moments of 10 ms, for each of which everybody is placed
//   where they were; the sensor itself moves from column to column. Blocks of 8 columns are traced
//   together, channel by channel: packets of rays that run alike. Points are gathered by block, so
//   that their order does not depend on threads.
// What it keeps: nothing.
#include "render/ranging/lidar.h"

#include <algorithm>
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
    const Sweep& sweep;
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

void put(Words& words, double value) {
    words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
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

    void trace(Words& words) {
        const std::size_t shots = columns_.size() * work_.elevations.size();
        beams_.reserve(shots * work_.rays);
        for (std::size_t ray = 0; ray < work_.rays; ++ray)
            for (std::size_t ring = 0; ring < work_.elevations.size(); ++ring)
                for (std::size_t i = 0; i < columns_.size(); ++i)
                    beams_.push_back(
                        {poses_[i].translation(), poses_[i].linear() * direction(i, ring, ray)});
        echoes_.resize(beams_.size());
        find_echoes(work_.scene, beams_, work_.range, work_.mask, echoes_);
        for (std::size_t i = 0; i < columns_.size(); ++i)
            for (std::size_t ring = 0; ring < work_.elevations.size(); ++ring)
                if (work_.optics != nullptr)
                    measure(words, i, ring);
                else
                    label(words, i, ring);
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

    void put_place(Words& words, std::size_t column, std::size_t ring, double range) const {
        const Vector3d p_sensor = range * direction(column, ring, 0);
        for (int axis = 0; axis < 3; ++axis)
            put(words, p_sensor[axis]);
    }

    void measure(Words& words, std::size_t column, std::size_t ring) const {
        const std::uint64_t shot = columns_[column].number * work_.elevations.size() + ring;
        if (work_.optics->dropoff_general > 0 &&
            work_.noise.uniform(shot, 0) < work_.optics->dropoff_general)
            return;
        std::array<Echo, rays_of_wide_beam> rays;
        for (std::size_t ray = 0; ray < work_.rays; ++ray)
            rays[ray] = echoes_[index(column, ring, ray)];
        const LidarReturns returns = returns_of(
            *work_.optics, work_.scene, std::span(rays).first(work_.rays), work_.noise, shot);
        for (std::size_t i = 0; i < returns.count; ++i) {
            put_place(words, column, ring, returns.found[i].range);
            put(words, static_cast<double>(returns.found[i].intensity));
            put(words, -columns_[column].ago);
            words.push_back(static_cast<std::uint32_t>(ring));
            words.push_back(static_cast<std::uint32_t>(i));
        }
    }

    void label(Words& words, std::size_t column, std::size_t ring) const {
        const Echo& echo = echoes_[index(column, ring, 0)];
        if (!echo)
            return;
        put_place(words, column, ring, echo.distance);
        put(words, static_cast<double>(echo.cosine));
        words.push_back(echo.instance->actor);
        words.push_back(static_cast<std::uint32_t>(semantic_class(work_.scene, echo.hit)));
        put(words, -columns_[column].ago);
        words.push_back(static_cast<std::uint32_t>(ring));
    }

    const Work& work_;
    std::span<const Sweep::Column> columns_;
    std::vector<Eigen::Isometry3d> poses_;
    std::vector<Eigen::Vector2d> azimuths_;
    std::vector<Beam> beams_;
    std::vector<Echo> echoes_;
};

/// Of a moment: columns whose time lies in the same 10 ms before the tick.
void trace_moment(const Work& work, std::span<const Sweep::Column> columns, Words& all) {
    std::vector<Words> found((columns.size() + block - 1) / block);
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
        const DefaultFloatMode plain;
        const std::size_t first = i * block;
        Block(work, columns.subspan(first, std::min(block, columns.size() - first)))
            .trace(found[i]);
    });
    for (const Words& words : found)
        all.insert(all.end(), words.begin(), words.end());
}

int moment_of(const Sweep::Column& column, bool rolls) {
    return rolls ? static_cast<int>(column.ago / moment) : 0;
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
    const std::uint32_t hidden = mount.hidden();
    const std::span<const std::uint32_t> mounts(&hidden, hidden != 0 ? 1 : 0);

    Words words;
    const std::span<const Sweep::Column> columns = sweep.columns;
    for (std::size_t first = 0; first < columns.size();) {
        const int now = moment_of(columns[first], rolls);
        std::size_t next = first;
        while (next < columns.size() && moment_of(columns[next], rolls) == now)
            ++next;
        // The first column of a moment was shot when the last one of the moment before it was.
        scene.place(tick, mounts, rolls ? (now + 0.5) * moment : 0);
        const Work work{scene,
                        spec,
                        sweep,
                        mount,
                        optics ? &*optics : nullptr,
                        noise,
                        world::attribute(spec, "range"),
                        rolls,
                        scene.mask_hiding(hidden),
                        elevations,
                        optics && optics->returns > 1 ? rays_of_wide_beam : 1};
        trace_moment(work, columns.subspan(first, next - first), words);
        first = next;
    }
    return point_frame(tick, spec, words);
}

}  // namespace reprise::render

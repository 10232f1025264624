#include "render/sensors.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "render/labels/channels.h"
#include "render/labels/flow.h"
#include "render/ranging/lidar.h"
#include "render/ranging/obstacle.h"
#include "render/ranging/radar.h"
#include "render/scene/scene.h"
#include "render/shade/frame.h"
#include "render/trace/default_float_mode.h"
#include "world/check.h"
#include "world/external/sensor_attributes.h"
#include "world/models/viewpoint.h"

namespace reprise::render {

namespace {

/// Looks at one tick after another. What is kept between calls: the sky of the last weather, and
/// memory for pictures.
class Observer {
  public:
    explicit Observer(const TownScene& town) : scene_(town), last_(town), next_(town) {}

    std::vector<world::SensorFrame> observe(const world::TickView& tick,
                                            const world::SensorRig& rig,
                                            const world::Weather& weather,
                                            const Neighbours& neighbours);

    std::vector<ProbeEcho> probe(const world::TickView& tick,
                                 std::span<const Probe> probes,
                                 double range,
                                 std::uint32_t carrier);

  private:
    /// Of cameras.
    std::vector<world::SensorFrame> look(const world::TickView& tick,
                                         const world::SensorRig& rig,
                                         const world::Weather& weather,
                                         const Neighbours& neighbours);

    /// Of what measures by rays. Places the scene as it needs it.
    world::SensorFrame measure(const world::TickView& tick,
                               const world::SensorSpec& spec,
                               const world::Weather& weather);
    void arrange_neighbours(const world::SensorRig& rig, const Neighbours& neighbours);
    std::vector<std::uint8_t> flow(const world::SensorSpec& spec,
                                   std::size_t number,
                                   const Camera& camera,
                                   const std::vector<Hit>& hits,
                                   const Neighbours& neighbours) const;

    Sky& sky_of(const world::Weather& weather) {
        if (!sky_ || !(sky_->weather() == weather))
            sky_.emplace(weather);
        return *sky_;
    }

    Scene scene_;
    Scene last_;  ///< where everybody was and will be, for who asks how things move
    Scene next_;
    std::optional<Sky> sky_;
    Frame frame_;
};

}  // namespace

/// What is kept between calls: the town, and who looked at it.
struct Sensors::Studio {
    Studio(const world::TownT& town, const Options& options) {
        REPRISE_CHECK(options.threads >= 0, std::to_string(options.threads) + " threads");
        if (options.threads > 0) {
            const auto threads = static_cast<std::size_t>(options.threads);
            limit.emplace(tbb::global_control::max_allowed_parallelism, threads);
            arena.initialize(options.threads);
        }
        arena.execute([&] {
            const DefaultFloatMode plain;
            still.emplace(town, options.portable);
        });
    }

    /// Calls `work` with an observer that nobody else has meanwhile.
    template <typename Work>
    void with_observer(const Work& work) {
        std::unique_ptr<Observer> observer;
        {
            const std::lock_guard hold(lock);
            if (!idle.empty()) {
                observer = std::move(idle.back());
                idle.pop_back();
            }
        }
        if (!observer)
            observer = std::make_unique<Observer>(*still);
        work(*observer);
        const std::lock_guard hold(lock);
        idle.push_back(std::move(observer));
    }

    // The limit also binds Embree, which has an arena of its own, and allows more threads than
    // cores.
    std::optional<tbb::global_control> limit;
    tbb::task_arena arena;
    std::optional<TownScene> still;
    std::mutex lock;
    std::vector<std::unique_ptr<Observer>> idle;
};

namespace {

/// Nothing where its carrier is not in the tick.
std::optional<Camera> find_camera(const world::TickView& tick,
                                  const world::SensorSpec& spec,
                                  const Eigen::Vector3d& origin) {
    std::optional<Eigen::Isometry3d> pose = Eigen::Isometry3d::Identity();
    if (spec.actor != 0)
        pose = world::find_pose(tick, spec.actor);
    if (!pose)
        return std::nullopt;
    pose->translation() -= origin;
    return Camera(spec, *pose);
}

Camera camera_of(const world::TickView& tick,
                 const world::SensorSpec& spec,
                 const Eigen::Vector3d& origin) {
    if (spec.width <= 0 || spec.height <= 0 || !(spec.fov > 0.001 && spec.fov < 3.1) ||
        !spec.position.allFinite() || !std::isfinite(spec.yaw) || !std::isfinite(spec.pitch) ||
        !std::isfinite(spec.roll))
        throw world::Error("sensor '" + spec.name +
                           "': size, field of view or place is not possible");
    const std::optional<Camera> camera = find_camera(tick, spec, origin);
    if (!camera)
        throw world::Error("sensor '" + spec.name + "': there is no actor " +
                           std::to_string(spec.actor) + " at tick " + std::to_string(tick.index()));
    return *camera;
}

/// Who is out of sight for a camera: the actor that it is fixed to. 0: nobody.
std::uint32_t hidden_from(const world::TickView& tick, const world::SensorSpec& spec) {
    if (world::attribute(spec, "own_car") > 0)
        return 0;
    const std::optional<world::Extent> extent = world::find_extent(tick, spec.actor);
    return extent && world::is_carried_at(*extent, spec.position) ? spec.actor : 0;
}

world::SensorFrame empty_frame(const world::TickView& tick, const world::SensorSpec& spec) {
    world::SensorFrame frame;
    frame.name = spec.name;
    frame.kind = spec.kind;
    frame.tick = tick.index();
    frame.width = spec.width;
    frame.height = spec.height;
    frame.channels = world::channels(spec.kind);
    frame.type = world::pixel_type(spec.kind);
    return frame;
}

bool looks_forward(const world::SensorSpec& spec) {
    return world::attribute(spec, "forward") > 0;
}

}  // namespace

Sensors::Sensors(const world::TownT& town, const Options& options)
    : studio_(std::make_unique<Studio>(town, options)) {}

Sensors::~Sensors() = default;

std::vector<world::SensorFrame> Sensors::observe(const world::TickView& tick,
                                                 const world::SensorRig& rig,
                                                 const world::Weather& weather,
                                                 const Neighbours& neighbours) {
    std::vector<world::SensorFrame> frames;
    studio_->arena.execute([&] {
        studio_->with_observer(
            [&](Observer& observer) { frames = observer.observe(tick, rig, weather, neighbours); });
    });
    return frames;
}

std::vector<ProbeEcho> Sensors::probe(const world::TickView& tick,
                                      std::span<const Probe> probes,
                                      double range,
                                      std::uint32_t carrier) {
    std::vector<ProbeEcho> answers;
    studio_->arena.execute([&] {
        studio_->with_observer(
            [&](Observer& observer) { answers = observer.probe(tick, probes, range, carrier); });
    });
    return answers;
}

void Sensors::observe_each(const std::function<std::unique_ptr<Observation>()>& next) {
    using tbb::filter_mode;
    // A few more than there are threads, so that nobody waits for who is late. Not more: what is
    // unfinished has to be noted down, see files/ending.h.
    const auto most =
        static_cast<std::size_t>(std::min(studio_->arena.max_concurrency() * 3 / 2 + 1, 40));
    using Asked = std::unique_ptr<Observation>;
    const auto ask = [&](tbb::flow_control& control) {
        Asked look = next();
        if (!look)
            control.stop();
        return look;
    };
    const auto see = [&](Asked look) {
        // Who waits for others in the middle of a picture helps them, and begins no other picture.
        tbb::this_task_arena::isolate([&] {
            studio_->with_observer([&](Observer& observer) {
                look->seen(observer.observe(
                    look->tick(), look->rig(), look->weather(), look->neighbours()));
            });
        });
        return look;
    };
    const auto finish = [](const Asked& look) { look->done(); };
    studio_->arena.execute([&] {
        tbb::parallel_pipeline(
            most,
            tbb::make_filter<void, Asked>(filter_mode::serial_in_order, ask) &
                tbb::make_filter<Asked, Asked>(filter_mode::parallel, see) &
                tbb::make_filter<Asked, void>(filter_mode::serial_in_order, finish));
    });
}

std::vector<world::SensorFrame> Observer::observe(const world::TickView& tick,
                                                  const world::SensorRig& rig,
                                                  const world::Weather& weather,
                                                  const Neighbours& neighbours) {
    const DefaultFloatMode plain;
    world::SensorRig cameras;
    for (const world::SensorSpec& spec : rig)
        if (!world::is_ranging(spec.kind))
            cameras.push_back(spec);
    std::vector<world::SensorFrame> seen;
    if (!cameras.empty())
        seen = look(tick, cameras, weather, neighbours);
    std::vector<world::SensorFrame> frames;
    auto picture = seen.begin();
    for (const world::SensorSpec& spec : rig)
        frames.push_back(world::is_ranging(spec.kind) ? measure(tick, spec, weather)
                                                      : std::move(*picture++));
    return frames;
}

world::SensorFrame Observer::measure(const world::TickView& tick,
                                     const world::SensorSpec& spec,
                                     const world::Weather& weather) {
    switch (spec.kind) {
        case world::SensorKind::radar:
            return radar_frame(scene_, tick, spec, weather);
        case world::SensorKind::obstacle:
            return obstacle_frame(scene_, tick, spec);
        default:
            return lidar_frame(scene_, tick, spec, weather);
    }
}

std::vector<ProbeEcho> Observer::probe(const world::TickView& tick,
                                       std::span<const Probe> probes,
                                       double range,
                                       std::uint32_t carrier) {
    const DefaultFloatMode plain;
    scene_.place(tick, std::span(&carrier, carrier != 0 ? 1U : 0U));
    return probe_scene(scene_, tick, probes, range, scene_.mask_hiding(carrier));
}

std::vector<world::SensorFrame> Observer::look(const world::TickView& tick,
                                               const world::SensorRig& rig,
                                               const world::Weather& weather,
                                               const Neighbours& neighbours) {
    Scene& placed = scene_;
    // From where cameras look, and who carries them out of their sight.
    std::vector<std::uint32_t> mounts;
    std::vector<Camera> cameras;
    for (const world::SensorSpec& spec : rig) {
        cameras.push_back(camera_of(tick, spec, placed.origin()));
        const std::uint32_t hidden = hidden_from(tick, spec);
        if (hidden != 0 && std::find(mounts.begin(), mounts.end(), hidden) == mounts.end())
            mounts.push_back(hidden);
    }
    placed.place(tick, mounts);
    arrange_neighbours(rig, neighbours);

    // Sensors of one place look once, together.
    std::vector<world::SensorFrame> frames(rig.size());
    std::vector<bool> done(rig.size(), false);
    std::vector<Hit> hits;
    for (std::size_t first = 0; first < rig.size(); ++first) {
        if (done[first])
            continue;
        const std::uint32_t hidden = hidden_from(tick, rig[first]);
        const std::uint32_t mask = placed.mask_hiding(hidden);
        trace_primary(placed, cameras[first], mask, hits);
        for (std::size_t i = first; i < rig.size(); ++i) {
            if (done[i] || rig[i].actor != rig[first].actor || !(cameras[i] == cameras[first]) ||
                hidden_from(tick, rig[i]) != hidden)
                continue;
            done[i] = true;
            frames[i] = empty_frame(tick, rig[i]);
            switch (rig[i].kind) {
                case world::SensorKind::depth:
                    frames[i].data = depth_bytes(hits);
                    break;
                case world::SensorKind::semantic:
                    frames[i].data = class_bytes(placed, hits);
                    break;
                case world::SensorKind::instance:
                    frames[i].data = instance_bytes(placed, hits);
                    break;
                case world::SensorKind::normals:
                    frames[i].data = normal_bytes(placed, cameras[i], hits);
                    break;
                case world::SensorKind::flow:
                    frames[i].data = flow(rig[i], i, cameras[i], hits, neighbours);
                    break;
                case world::SensorKind::rgb: {
                    Sky& sky = sky_of(weather);
                    sky.look_from(
                        cameras[i].position().cast<float>(), placed.town().ground(), tick.index());
                    const ShadingInput input{placed, sky, tick.index()};
                    shade(input, cameras[i], mask, hits, frame_);
                    draw_rain(input, cameras[i], hits, frame_);
                    draw_snow(input, cameras[i], hits, frame_);
                    if (rig[i].actor != 0)
                        wet_lens(input, frame_);
                    frames[i].data = tone_map(frame_, tick.index());
                    break;
                }
                default:
                    throw world::Error("sensor '" + rig[i].name + "': no pictures of its kind");
            }
        }
    }
    return frames;
}

void Observer::arrange_neighbours(const world::SensorRig& rig, const Neighbours& neighbours) {
    bool last = false;
    bool next = false;
    for (const world::SensorSpec& spec : rig)
        if (spec.kind == world::SensorKind::flow)
            (looks_forward(spec) ? next : last) = true;
    if (last && neighbours.last)
        last_.arrange(neighbours.last->tick);
    if (next && neighbours.next)
        next_.arrange(neighbours.next->tick);
}

/// `number`: of the sensor in the rig.
std::vector<std::uint8_t> Observer::flow(const world::SensorSpec& spec,
                                         std::size_t number,
                                         const Camera& camera,
                                         const std::vector<Hit>& hits,
                                         const Neighbours& neighbours) const {
    const bool forward = looks_forward(spec);
    const std::optional<Neighbour>& neighbour = forward ? neighbours.next : neighbours.last;
    std::optional<OtherTick> other;
    if (neighbour) {
        const world::SensorSpec& there = neighbour->rig.empty() ? spec : neighbour->rig.at(number);
        if (const auto from = find_camera(neighbour->tick, there, scene_.origin()))
            other.emplace(OtherTick{forward ? next_ : last_, *from});
    }
    return flow_bytes(scene_, camera, hits, other ? &*other : nullptr, forward);
}

}  // namespace reprise::render

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
#include "render/optics/develop.h"
#include "render/optics/events.h"
#include "render/optics/photograph.h"
#include "render/ranging/lidar.h"
#include "render/ranging/obstacle.h"
#include "render/ranging/radar.h"
#include "render/scene/scene.h"
#include "render/shade/frame.h"
#include "render/trace/default_float_mode.h"
#include "world/check.h"
#include "world/external/rig.h"
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

    /// What cameras of one place and lens have in common.
    struct Look {
        const world::TickView& tick;
        const world::SensorRig& rig;
        const Neighbours& neighbours;
        const std::vector<std::uint32_t>& mounts;
        std::vector<std::size_t> cameras;  ///< by their number in the rig
        Stage stage;
        Sight sight;
        std::vector<Band> bands;
        std::vector<Hit> hits;
    };

    void label(Look& look, std::vector<world::SensorFrame>& frames);
    std::vector<std::uint8_t> photograph(Look& look, std::size_t number, Sky& sky);
    void watch(Look& look, std::size_t number, Sky& sky, world::SensorFrame& frame);
    Sight sight_of(const world::SensorSpec& spec,
                   std::size_t number,
                   const Camera& camera,
                   std::uint32_t mask,
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
    Frame work_;
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
    if (spec.width <= 0 || spec.height <= 0 || !(spec.fov > 0.001 && spec.fov < 3.5) ||
        !spec.position.allFinite() || !std::isfinite(spec.yaw) || !std::isfinite(spec.pitch) ||
        !std::isfinite(spec.roll))
        throw world::Error("sensor '" + spec.name +
                           "': size, field of view or place is not possible");
    if (const std::string why = world::contradiction(spec); !why.empty())
        throw world::Error("sensor '" + spec.name + "': " + why);
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
    // Who fails ends all of it, and loops that others are in end early: their frames look whole.
    tbb::task_group_context whole;
    const auto see = [&](Asked look) {
        // Who waits for others in the middle of a picture helps them, and begins no other picture.
        tbb::this_task_arena::isolate([&] {
            studio_->with_observer([&](Observer& observer) {
                std::vector<world::SensorFrame> frames = observer.observe(
                    look->tick(), look->rig(), look->weather(), look->neighbours());
                if (whole.is_group_execution_cancelled())
                    look.reset();
                else
                    look->seen(std::move(frames));
            });
        });
        return look;
    };
    const auto finish = [](const Asked& look) {
        if (look)
            look->done();
    };
    studio_->arena.execute([&] {
        tbb::parallel_pipeline(
            most,
            tbb::make_filter<void, Asked>(filter_mode::serial_in_order, ask) &
                tbb::make_filter<Asked, Asked>(filter_mode::parallel, see) &
                tbb::make_filter<Asked, void>(filter_mode::serial_in_order, finish),
            whole);
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
    for (std::size_t first = 0; first < rig.size(); ++first) {
        if (done[first])
            continue;
        const std::uint32_t hidden = hidden_from(tick, rig[first]);
        const bool moves = std::any_of(rig.begin(), rig.end(), world::takes_time);
        Look look{
            tick,
            rig,
            neighbours,
            mounts,
            {},
            Stage(
                placed, moves && neighbours.last ? &last_ : nullptr, tick, mounts, rig[first].step),
            sight_of(rig[first], first, cameras[first], placed.mask_hiding(hidden), neighbours),
            bands_of(rig[first]),
            {}};
        for (std::size_t i = first; i < rig.size(); ++i) {
            if (done[i] || rig[i].actor != rig[first].actor || !(cameras[i] == cameras[first]) ||
                hidden_from(tick, rig[i]) != hidden ||
                Shutter(rig[i]).readout != Shutter(rig[first]).readout)
                continue;
            done[i] = true;
            frames[i] = empty_frame(tick, rig[i]);
            look.cameras.push_back(i);
        }
        label(look, frames);
        for (const std::size_t i : look.cameras) {
            if (rig[i].kind == world::SensorKind::rgb)
                frames[i].data = photograph(look, i, sky_of(weather));
            else if (rig[i].kind == world::SensorKind::dvs)
                watch(look, i, sky_of(weather), frames[i]);
            blank_unseen(cameras[i], frames[i]);
        }
        look.stage.go_back(0);
    }
    return frames;
}

/// Where the camera was at the last tick as well; not where it jumped, as views do that follow.
Sight Observer::sight_of(const world::SensorSpec& spec,
                         std::size_t number,
                         const Camera& camera,
                         std::uint32_t mask,
                         const Neighbours& neighbours) {
    constexpr double jump = 4;  // [m] between two ticks
    Sight sight{camera, std::nullopt, mask};
    if (neighbours.last) {
        const world::SensorRig& rig = neighbours.last->rig;
        const world::SensorSpec& there = rig.empty() ? spec : rig.at(number);
        sight.last = find_camera(neighbours.last->tick, there, scene_.origin());
        if (sight.last && (sight.last->position() - camera.position()).norm() > jump)
            sight.last.reset();
    }
    return sight;
}

/// What is seen first, and all that says what that is: row by row at the time of each.
void Observer::label(Look& look, std::vector<world::SensorFrame>& frames) {
    const bool whole = look.bands.size() == 1;
    std::vector<Hit> rows;
    for (const Band& band : look.bands) {
        look.stage.go_back(band.ago);
        const Camera camera =
            whole ? look.sight.now
                  : look.sight.at(look.stage.share(band.ago)).cropped(band.first, band.rows);
        trace_primary(scene_, camera, look.sight.mask, whole ? look.hits : rows);
        const std::vector<Hit>& hits = whole ? look.hits : rows;
        for (const std::size_t i : look.cameras) {
            std::vector<std::uint8_t>& data = frames[i].data;
            const auto take = [&](const std::vector<std::uint8_t>& bytes) {
                data.insert(data.end(), bytes.begin(), bytes.end());
            };
            switch (look.rig[i].kind) {
                case world::SensorKind::depth:
                    take(depth_bytes(hits));
                    break;
                case world::SensorKind::semantic:
                    take(class_bytes(scene_, hits));
                    break;
                case world::SensorKind::instance:
                    take(instance_bytes(scene_, hits));
                    break;
                case world::SensorKind::normals:
                    take(normal_bytes(scene_, camera, hits));
                    break;
                case world::SensorKind::flow:
                    take(flow(look.rig[i], i, camera, hits, look.neighbours));
                    break;
                case world::SensorKind::rgb:
                case world::SensorKind::dvs:
                    break;
                default:
                    throw world::Error("sensor '" + look.rig[i].name +
                                       "': no pictures of its kind");
            }
        }
        if (!whole)
            look.hits.insert(look.hits.end(), rows.begin(), rows.end());
    }
}

std::vector<std::uint8_t> Observer::photograph(Look& look, std::size_t number, Sky& sky) {
    const world::SensorSpec& spec = look.rig[number];
    const Camera& camera = look.sight.now;
    const std::uint64_t tick = look.tick.index();
    sky.look_from(camera.position().cast<float>(), scene_.town().ground(), tick);
    const ShadingInput input{scene_, sky, tick};
    const Shutter shutter(spec);
    if (shutter.blurs() || shutter.open > 0 || shutter.sharp > 0 || look.bands.size() > 1) {
        gather_light(look.stage, look.sight, shutter, look.bands, input, work_, frame_);
        look.stage.go_back(0);
    } else {
        shade(input, camera, look.sight.mask, look.hits, frame_);
    }
    add_glare(frame_, sky.lamplight());
    draw_rain(input, camera, look.hits, frame_);
    draw_snow(input, camera, look.hits, frame_);
    if (spec.actor != 0)
        wet_lens(input, frame_);
    return develop(spec, sky, tick, frame_);
}

/// Pictures of the last tick, of instants between, and of this tick, for what changes between them.
/// Drops and flakes that fall are not in them.
void Observer::watch(Look& look, std::size_t number, Sky& sky, world::SensorFrame& frame) {
    const world::SensorSpec& spec = look.rig[number];
    const auto samples = static_cast<int>(world::attribute(spec, "samples"));
    std::vector<LogPicture> pictures;
    const auto see = [&](const Camera& camera, std::uint64_t tick, double ago) {
        sky.look_from(camera.position().cast<float>(), scene_.town().ground(), tick);
        const ShadingInput input{scene_, sky, tick};
        trace_primary(scene_, camera, look.sight.mask, look.hits);
        shade(input, camera, look.sight.mask, look.hits, frame_);
        add_glare(frame_, sky.lamplight());
        pictures.push_back(log_picture(
            frame_,
            world::attribute(spec, "log_eps"),
            std::llround((static_cast<double>(look.tick.index()) * spec.step - ago) * 1e9)));
    };
    if (look.neighbours.last && look.sight.last) {
        const world::TickView& last = look.neighbours.last->tick;
        scene_.place(last, look.mounts);
        see(*look.sight.last, last.index(), spec.step);
        look.stage.forget_place();
        for (int i = 1; i <= samples; ++i) {
            const double ago = spec.step * (samples - i) / samples;
            look.stage.go_back(ago);
            see(look.sight.at(look.stage.share(ago)), look.tick.index(), ago);
        }
    }
    find_events(spec, pictures, frame);
}

void Observer::arrange_neighbours(const world::SensorRig& rig, const Neighbours& neighbours) {
    bool last = false;
    bool next = false;
    for (const world::SensorSpec& spec : rig)
        if (spec.kind == world::SensorKind::flow)
            (looks_forward(spec) ? next : last) = true;
        else if (world::takes_time(spec))
            last = true;
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

#include "render/observer.h"

#include <algorithm>
#include <cmath>

#include "render/carried_camera.h"
#include "render/labels/channels.h"
#include "render/labels/flow.h"
#include "render/optics/develop.h"
#include "render/optics/events.h"
#include "render/ranging/lidar.h"
#include "render/ranging/obstacle.h"
#include "render/ranging/radar.h"
#include "render/trace/default_float_mode.h"
#include "world/external/rig.h"
#include "world/external/sensor_attributes.h"

namespace reprise::render {

namespace {

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
            hits_};
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

Sky& Observer::sky_of(const world::Weather& weather) {
    constexpr std::size_t most = 6;  // of 0.9 MB
    const auto known = std::find_if(
        skies_.begin(), skies_.end(), [&](const auto& sky) { return sky->weather() == weather; });
    if (known != skies_.end()) {
        std::rotate(skies_.begin(), known, known + 1);
    } else {
        skies_.resize(std::min(skies_.size(), most - 1));
        skies_.insert(skies_.begin(), std::make_unique<Sky>(weather));
    }
    return *skies_.front();
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
    if (!whole)
        look.hits.clear();
    for (const Band& band : look.bands) {
        look.stage.go_back(band.ago);
        const Camera camera =
            whole ? look.sight.now
                  : look.sight.at(look.stage.share(band.ago)).cropped(band.first, band.rows);
        trace_primary(scene_, camera, look.sight.mask, whole ? look.hits : rows);
        const std::vector<Hit>& hits = whole ? look.hits : rows;
        for (const std::size_t i : look.cameras) {
            std::vector<std::uint8_t>& data = frames[i].data;
            const auto take = [&](std::vector<std::uint8_t> bytes) {
                if (whole)
                    data = std::move(bytes);
                else
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
        scene_.map_crowd();
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

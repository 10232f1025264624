// Must: equal logs give equal ticks; every number in a tick is finite and on the record's grid.
// Assumes: frames in order of time; all actors were surveyed.
// Goes: two frames are held, the tick lies between them; events of a frame go into the first
//   tick that does not lie before it.
// Keeps: of each actor the distance covered, so that wheels and legs turn with it.
#include "exchange/carla/carla_ticks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "exchange/carla/carla_bodies.h"
#include "exchange/carla/carla_events.h"
#include "world/digest.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/town.h"
#include "world/weather/weather.h"

namespace reprise::exchange {

namespace {

using Eigen::Vector3d;
using world::rounded;

constexpr double per_radian = 8192;
constexpr double per_acceleration = 64;

/// What is carried from tick to tick for one actor: odometer, walk cycle, last motion.
struct Track {
    double driven = 0;  ///< [m]
    double phase = 0;   ///< of the walk cycle, in [0, 1)
    double speed = 0;   ///< [m/s] along its x axis at the last tick
    Vector3d velocity = Vector3d::Zero();
    Vector3d position = Vector3d::Zero();
    std::uint64_t tick = 0;  ///< the last one that it was in
};

world::SignalColor color_of(CarlaColor color) {
    switch (color) {
        case CarlaColor::red:
            return world::SignalColor::red;
        case CarlaColor::yellow:
            return world::SignalColor::yellow;
        case CarlaColor::green:
            return world::SignalColor::green;
        default:
            return world::SignalColor::off;
    }
}

float on_grid(double value, double per_unit) {
    return static_cast<float>(rounded(value, per_unit));
}

/// Of the id alone: colours that CARLA recorded are not paints of ours.
world::Look look_of_imported(std::uint32_t actor) {
    return world::drawn_look(0, actor);
}

/// Rounding must not leave (-pi, pi].
float yaw_on_grid(double yaw) {
    const double largest = std::floor(std::numbers::pi * per_radian) / per_radian;
    return static_cast<float>(
        std::clamp(rounded(world::wrap_angle(yaw), per_radian), -largest, largest));
}

}  // namespace

struct CarlaTicks::State {
    CarlaLog& log;
    const CarlaSurvey& survey;
    const world::TownT& town;
    std::vector<std::uint32_t> lights;
    Vector3d offset;
    CarlaTiming timing;
    CarlaEvents events;
    std::optional<world::LaneMap> lanes{};
    Instant before{};
    std::optional<Instant> after{};
    const CarlaFrame* frame = nullptr;  ///< that `after` is of
    std::map<std::uint32_t, CarlaColor> colors{};
    std::map<std::uint32_t, Track> tracks{};
    std::uint64_t tick = 0;
    std::uint64_t jumps = 0;

    void read_next();
    void pass_frame();
    /// Calls visit(from, to) for everybody before; `to` is null for those who are not there after.
    template <typename Visit>
    void pair_up(Visit visit) const;
    Vector3d velocity_of(const Body& body);
    void add_car(const Body& body, world::TickDraft& draft);
    void add_walker(const Body& body, world::TickDraft& draft);
    void add_bodies(double time, world::TickDraft& draft);
    void seal_digests(world::TickDraft& draft) const;
};

/// Reads the frame that follows `before` into `after`; none at the end of the log.
void CarlaTicks::State::read_next() {
    after.reset();
    frame = log.next();
    if (frame != nullptr)
        after = instant_of(*frame, survey, offset);
}

/// Makes the next frame the current one: notes its light colours and events, and counts jumps.
void CarlaTicks::State::pass_frame() {
    for (const CarlaLight& light : frame->lights)
        colors[light.actor] = light.color;
    events.read(*frame, before.bodies);
    before = std::move(*after);
    read_next();
    const double duration = after ? after->elapsed - before.elapsed : 0;
    pair_up([&](const Body& from, const Body* to) {
        jumps += to != nullptr && jumps_between(from, *to, duration) ? 1 : 0;
    });
}

template <typename Visit>
void CarlaTicks::State::pair_up(Visit visit) const {
    std::size_t next = 0;
    const std::size_t count = after ? after->bodies.size() : 0;
    for (const Body& from : before.bodies) {
        while (next < count && after->bodies[next].id < from.id)
            ++next;
        visit(from,
              next < count && after->bodies[next].id == from.id ? &after->bodies[next] : nullptr);
    }
}

/// As recorded, or as it follows from the places; at the log's end as it was.
Vector3d CarlaTicks::State::velocity_of(const Body& body) {
    const Track& track = tracks[body.id];
    if (!body.velocity && !after && track.tick + 1 == tick)
        return track.velocity;
    return body.velocity.value_or(Vector3d(Vector3d::Zero()));
}

void CarlaTicks::State::add_car(const Body& body, world::TickDraft& draft) {
    const world::VehicleModel& model = world::vehicle_models()[survey.roles.at(body.id).model];
    const double step = static_cast<double>(timing.step_ns) * 1e-9;
    const Vector3d ahead = ahead_of(body.yaw, body.pitch);
    const Vector3d velocity = velocity_of(body);
    const double speed = velocity.dot(ahead);
    Track& track = tracks[body.id];
    const bool goes_on = track.tick + 1 == tick;
    const double moved = goes_on ? (body.position - track.position).dot(ahead) : 0;
    if (std::abs(moved) < 1 + fastest * step)
        track.driven += moved;
    const double acceleration = goes_on ? (speed - track.speed) / step : 0;
    track = {track.driven, 0, speed, velocity, body.position, tick};

    std::uint32_t lane = world::none;
    double lane_s = track.driven;
    if (lanes) {
        const Vector3d front = body.position + (model.length - model.rear_overhang) * ahead;
        if (const auto found = lanes->best(front, body.yaw, 4)) {
            lane = found->lane;
            lane_s = found->at.s;
        }
    }
    draft.traffic.cars.emplace_back(on_grid(body.position),
                                    yaw_on_grid(body.yaw),
                                    on_grid(body.pitch, per_radian),
                                    on_grid(speed, per_metre),
                                    on_grid(lane_s, per_metre),
                                    body.id,
                                    lane,
                                    survey.roles.at(body.id).model,
                                    body.lamps,
                                    on_grid(acceleration, per_acceleration));
    draft.traffic.looks.push_back(look_of_imported(body.id));
}

void CarlaTicks::State::add_walker(const Body& body, world::TickDraft& draft) {
    constexpr double standing = 0.05;  // [m/s]
    const std::uint16_t model = survey.roles.at(body.id).model;
    const Vector3d velocity = velocity_of(body);
    const double speed = velocity.head<2>().norm();
    Track& track = tracks[body.id];
    const double moved =
        track.tick + 1 == tick ? (body.position - track.position).head<2>().norm() : 0;
    if (speed > standing && moved < fastest)
        track.phase += moved / timing.walk_cycle(speed, world::walker_models()[model].height);
    track = {0, track.phase - std::floor(track.phase), speed, velocity, body.position, tick};
    draft.traffic.walkers.emplace_back(
        on_grid(body.position),
        yaw_on_grid(body.yaw),
        on_grid(speed, per_metre),
        static_cast<float>(std::floor(track.phase * per_radian) / per_radian),
        body.id,
        model,
        false,
        std::uint8_t{0},
        look_of_imported(body.id).look());
}

void CarlaTicks::State::add_bodies(double time, world::TickDraft& draft) {
    const double duration = after ? after->elapsed - before.elapsed : 0;
    const double share =
        duration > 0 ? std::clamp((time - before.elapsed) / duration, 0.0, 1.0) : 0;
    pair_up([&](const Body& from, const Body* to) {
        const Body body = to == nullptr ? from : between(from, *to, share, duration);
        if (survey.roles.at(body.id).actor.kind == CarlaKind::walker)
            add_walker(body, draft);
        else
            add_car(body, draft);
    });
}

/// As the kernel's stages have them; events are of the scenario here.
void CarlaTicks::State::seal_digests(world::TickDraft& draft) const {
    world::Hasher scenario;
    scenario.add(draft.tick.weather);
    for (const world::EventT& event : draft.tick.events) {
        scenario.add(event.kind);
        scenario.add(event.actor);
        scenario.add(event.other);
        scenario.add(event.position);
        scenario.add_text(event.text);
    }
    world::Hasher cars;
    cars.add(std::span<const world::CarState>(draft.traffic.cars));
    cars.add(std::span<const world::Look>(draft.traffic.looks));
    cars.add(std::span<const world::SignalColor>(draft.tick.signals));
    world::Hasher walkers;
    walkers.add(std::span<const world::WalkerState>(draft.traffic.walkers));
    draft.tick.digests =
        world::Digests(scenario.digest64(), 0, cars.digest64(), walkers.digest64(), 0, 0, {}, {});
}

CarlaTicks::CarlaTicks(CarlaLog& log,
                       const CarlaSurvey& survey,
                       const world::TownT& town,
                       std::vector<std::uint32_t> lights,
                       const Vector3d& offset,
                       const CarlaTiming& timing)
    : state_(new State{
          log, survey, town, std::move(lights), offset, timing, CarlaEvents(survey, offset)}) {
    const bool has_roads = std::any_of(town.lanes.begin(), town.lanes.end(), world::is_for_cars);
    if (has_roads)
        state_->lanes.emplace(town);
    log.rewind();
    state_->read_next();
}

CarlaTicks::~CarlaTicks() = default;

world::TickDraft CarlaTicks::next() {
    State& state = *state_;
    world::TickDraft draft;
    draft.tick.index = ++state.tick;
    const double time = state.survey.first + world::seconds(state.tick, state.timing.step_ns);
    while (state.after && state.after->elapsed <= time)
        state.pass_frame();
    draft.tick.weather = world::find_weather("clear_noon")->weather;
    draft.tick.road_friction = 1;
    for (const std::uint32_t light : state.lights) {
        const auto color = state.colors.find(light);
        draft.tick.signals.push_back(color == state.colors.end() ? world::SignalColor::off
                                                                 : color_of(color->second));
    }
    state.add_bodies(time, draft);
    draft.tick.events = state.events.take();
    state.seal_digests(draft);
    return draft;
}

std::uint64_t CarlaTicks::jumps() const {
    return state_->jumps;
}

}  // namespace reprise::exchange

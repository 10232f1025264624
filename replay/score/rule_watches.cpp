// Watches for what traffic rules say: lights, stop signs, limits.
#include <algorithm>
#include <cmath>

#include "replay/score/watches.h"

namespace reprise::replay {

namespace {

/// As RunningStopTest of CARLA's scenario runner: within so many metres before the line a vehicle
/// was slower than that.
constexpr double stop_reach = 4;       // [m]
constexpr double stopped_speed = 0.1;  // [m/s]

/// What speed meters of the police may be off, and so what is taken off before it is counted: 3
/// km/h, of more than 100 km/h 3 % (PTB-A 12.01, the limits of error in traffic).
constexpr double meter_error = 3 / 3.6;  // [m/s]
constexpr double meter_error_share = 0.03;

Eigen::Vector3d front_of(const Sight& sight) {
    const Eigen::Vector2d ahead = world::ahead_of(sight.yaw());
    return sight.position() + sight.front() * Eigen::Vector3d(ahead.x(), ahead.y(), 0);
}

/// The line at which a light other than a stop sign says what to do.
bool has_light(const world::TickView& tick, const world::LaneT& lane, bool is_sign) {
    return std::any_of(lane.links.begin(), lane.links.end(), [&](const world::Link& link) {
        if (link.signal() >= tick.signals().size())
            return false;
        const world::SignalColor color = tick.signals()[link.signal()];
        return is_sign ? color == world::SignalColor::stop
                       : color != world::SignalColor::stop && color != world::SignalColor::off;
    });
}

}  // namespace

std::optional<std::uint32_t> FrontWatch::crossed(const world::StopLines& lines,
                                                 const Sight& sight) const {
    return p_front_ && !sight.is_put ? lines.crossed(*p_front_, front_of(sight)) : std::nullopt;
}

void FrontWatch::remember(const Sight& sight) {
    p_front_ = front_of(sight);
}

void RedLightWatch::look(const Sight& sight) {
    if (const auto lane = front_.crossed(town_.signal_lines, sight)) {
        at_line_ = begun(InfractionKind::red_light, sight, sight.measured.speed());
        at_line_->lane = *lane;
    }
    front_.remember(sight);
    const auto observe = [&] {
        lights_.observe(town_.town,
                        town_.signal_lines,
                        sight.tick,
                        sight.position(),
                        sight.yaw(),
                        sight.front(),
                        Sight::farthest(sight.measured.speed(), sight.step));
    };
    observe();
    if (!lights_.ran_red())
        return;
    if (at_line_) {
        begin(*at_line_);
        end(*at_line_);
    }
    at_line_.reset();
    lights_ = {};  // for the next one
    observe();
}

void StopSignWatch::look(const Sight& sight) {
    if (sight.is_put)
        since_stop_.reset();
    if (since_stop_)
        *since_stop_ += sight.driven;
    const bool stopped = since_stop_ && *since_stop_ <= stop_reach + world::StopLines::slack;
    auto lane = front_.crossed(town_.sign_lines, sight);
    if (lane && has_light(sight.tick, town_.town.lanes[*lane], false))
        lane.reset();
    if (!lane) {
        lane = front_.crossed(town_.signal_lines, sight);
        if (lane && !has_light(sight.tick, town_.town.lanes[*lane], true))
            lane.reset();
    }
    front_.remember(sight);
    if (lane && !stopped) {
        Infraction infraction = begun(InfractionKind::stop_sign, sight, sight.measured.speed());
        infraction.lane = *lane;
        begin(infraction);
        end(infraction);
    }
    if (std::abs(sight.measured.speed()) < stopped_speed)
        since_stop_ = 0;
}

std::optional<double> SpeedWatch::value(const Sight& sight) {
    const std::uint32_t index = sight.measured.lane();
    if (index >= town_.town.lanes.size())
        return std::nullopt;
    // Inside of junctions SUMO's limit is what a bend allows, and no sign says it; but one may
    // speed up in it to what the street behind it allows.
    const world::LaneT& lane = town_.town.lanes[index];
    double limit = lane.speed_limit;
    if (lane.kind == world::LaneKind::driving)
        limit_ = limit;
    else
        limit = std::max(limit, limit_.value_or(0));
    const double above = std::abs(sight.measured.speed()) - limit;
    if (above <= std::max(meter_error, meter_error_share * limit))
        return std::nullopt;
    return above;
}

}  // namespace reprise::replay

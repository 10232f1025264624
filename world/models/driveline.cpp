#include "world/models/driveline.h"

#include <algorithm>

namespace reprise::world {

namespace {

// Of the engine's speed at its largest power.
constexpr double calm = 0.28;       // a higher gear is taken from here on
constexpr double labouring = 0.20;  // a gear is left for a lower one from here down
constexpr double spin_up = 2.5;     // an engine off its gears gains so much in a second

constexpr double reserve = 1.15;      // of force, in a gear that is changed up to
constexpr double worth_it = 1.03;     // of force, of a gear that is changed to for force
constexpr double rest_between = 0.5;  // [s] between two changes

}  // namespace

Driveline::Driveline(const Powertrain& train, double speed)
    : train_(&train),
      since_change_(rest_between) {
    settle(speed);
}

void Driveline::settle(double speed) {
    if (train_->gears == 0)
        return;
    reverse_ = false;
    gear_ = highest_with(0, calm * train_->peak_speed, std::max(speed, 0.0));
    last_gear_ = gear_;
    changing_ = 0;
    engine_speed_ =
        std::clamp(train_->engine_speed(gear_, speed), train_->idle_speed, train_->limit_speed);
}

/// The highest gear with so much force at no less than this engine speed; 0 where there is none
/// with the force, else the first.
int Driveline::highest_with(double force, double engine_speed, double speed) const {
    for (int gear = train_->gears; gear > 1; --gear)
        if (train_->engine_speed(gear, speed) >= engine_speed &&
            train_->force(gear, speed) >= force)
            return gear;
    return train_->force(1, speed) >= force ? 1 : 0;
}

int Driveline::wanted_gear(double force, double speed) const {
    const Powertrain& t = *train_;
    const double shaft = t.engine_speed(gear_, speed);
    if (gear_ > 1 && shaft < labouring * t.peak_speed)
        return std::max(highest_with(0, labouring * t.peak_speed, speed), 1);
    if (gear_ < t.gears && shaft > 0.98 * t.limit_speed)
        return gear_ + 1;
    const double given = t.force(gear_, speed);
    if (given >= force / worth_it)
        return std::max(gear_, highest_with(reserve * force, calm * t.peak_speed, speed));
    // Too weak.
    const int enough = highest_with(force, labouring * t.peak_speed, speed);
    if (enough > 0)
        return enough;
    int strongest = gear_;
    for (int gear = 1; gear <= t.gears; ++gear)
        if (t.force(gear, speed) > worth_it * t.force(strongest, speed))
            strongest = gear;
    return strongest;
}

void Driveline::shift(double force, double speed, double step) {
    changing_ = std::max(changing_ - step, 0.0);
    since_change_ += step;
    if (changing_ > 0)
        return;
    last_gear_ = gear_;
    const int wanted = wanted_gear(force, speed);
    const bool must = train_->engine_speed(gear_, speed) > 0.98 * train_->limit_speed;
    if (wanted == gear_ || (since_change_ < rest_between && !must))
        return;
    gear_ = wanted;
    changing_ = train_->shift_time;
    since_change_ = 0;
}

void Driveline::turn_engine(double throttle, double speed, double step) {
    const Powertrain& t = *train_;
    const double to_go = changing_ / t.shift_time;
    const double shaft =
        to_go * t.engine_speed(last_gear_, speed) + (1 - to_go) * t.engine_speed(gear_, speed);
    // A clutch or converter that slips lets the engine turn as the pedal says.
    const double slipping = t.idle_speed + throttle * (t.launch_speed - t.idle_speed);
    const double wanted = std::min(std::max(shaft, slipping), t.limit_speed);
    const double most = spin_up * t.peak_speed * step;
    engine_speed_ += std::clamp(wanted - engine_speed_, -most, most);
}

double Driveline::drive(double wanted, double throttle, bool reverse, double speed, double step) {
    if (train_->gears == 0)
        return wanted;
    const double along = std::max(reverse ? -speed : speed, 0.0);
    if (reverse || reverse_ != reverse) {
        reverse_ = reverse;
        gear_ = last_gear_ = 1;
        changing_ = 0;
    }
    if (!reverse)
        shift(wanted, along, step);
    turn_engine(throttle, along, step);
    if (reverse)
        return wanted;
    return std::min(wanted, train_->force(std::max(gear_, last_gear_), along));
}

int Driveline::gear() const {
    return reverse_ ? -1 : gear_;
}

void Driveline::add_to(Hasher& hasher) const {
    hasher.add(gear_);
    hasher.add(last_gear_);
    hasher.add(changing_);
    hasher.add(since_change_);
    hasher.add(engine_speed_);
    hasher.add(reverse_);
}

}  // namespace reprise::world

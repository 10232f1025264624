#include "replay/table/statistics.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "replay/table/kept.h"
#include "world/models/catalogue.h"

namespace reprise::replay {

namespace {

/// A vehicle and what only counting needs.
struct Count {
    VehicleStatistics result;
    double first_odometer = 0;
    double last_odometer = 0;
    double sum_of_speeds = 0;
    bool braking = false;
};

class Counter {
  public:
    TraceStatistics result;

    void add(const RecordedTick& tick) {
        const world::TickView& view = tick.view;
        ++result.ticks;
        result.tick_bytes += tick.tick_bytes.size();
        result.traffic_bytes += tick.traffic_bytes.size();
        if (view.traffic != nullptr) {
            ++result.traffic_ticks;
            add(view.cars().size(), result.cars);
            add(view.walkers().size(), result.walkers);
        }
        result.commands += view.tick->commands()->size();
        for (const world::VehicleState& vehicle : view.vehicles())
            add(vehicle);
        for (const world::Measurement& measurement : view.measurements())
            add(measurement);
        for (const world::Event* event : *view.tick->events())
            add(*event);
    }

    TraceStatistics finish() {
        const auto ticks = static_cast<double>(std::max<std::uint64_t>(result.traffic_ticks, 1));
        result.cars.mean /= ticks;
        result.walkers.mean /= ticks;
        for (auto& [id, count] : vehicles_) {
            VehicleStatistics& vehicle = count.result;
            if (vehicle.ticks == 0)
                continue;  // an event named it, but it was no vehicle with mass
            vehicle.id = id;
            vehicle.distance = count.last_odometer - count.first_odometer;
            vehicle.mean_speed = count.sum_of_speeds / static_cast<double>(vehicle.ticks);
            result.vehicles.push_back(std::move(vehicle));
        }
        return std::move(result);
    }

    void learn_names(const world::TickView& tick) {
        for (const world::Event* event : *tick.tick->events())
            learn_name(*event);
    }

  private:
    void learn_name(const world::Event& event) {
        if (event.kind() == world::EventKind::spawned && event.text() != nullptr &&
            event.actor() < world::first_background_id)
            vehicles_[event.actor()].result.name = event.text()->str();
    }

    void add(std::size_t now, CountRange& range) const {
        range.least = result.traffic_ticks == 1 ? now : std::min(range.least, now);
        range.most = std::max(range.most, now);
        range.mean += static_cast<double>(now);
    }

    void add(const world::VehicleState& vehicle) {
        Count& count = vehicles_[vehicle.id()];
        if (count.result.ticks++ == 0) {
            count.first_odometer = vehicle.odometer();
            const auto models = world::vehicle_models();
            if (vehicle.model() < models.size())
                count.result.model = models[vehicle.model()].name;
        }
        count.last_odometer = vehicle.odometer();
    }

    void add(const world::Measurement& measured) {
        Count& count = vehicles_[measured.actor()];
        VehicleStatistics& vehicle = count.result;
        const double speed = std::abs(measured.speed());
        count.sum_of_speeds += speed;
        vehicle.max_speed = std::max(vehicle.max_speed, speed);
        vehicle.standing += speed < standing_speed ? 1 : 0;
        const double deceleration =
            measured.speed() >= 0 ? -measured.acceleration() : measured.acceleration();
        vehicle.max_deceleration = std::max(vehicle.max_deceleration, deceleration);
        if (!count.braking && deceleration >= hard_brake)
            ++vehicle.hard_brakes;
        count.braking = deceleration >= (count.braking ? hard_brake / 2 : hard_brake);
        vehicle.impulse =
            measured.impulse_vehicles() + measured.impulse_walkers() + measured.impulse_static();
        vehicle.on_opposite_lane += measured.on_opposite_lane() > 0 ? 1 : 0;
        vehicle.on_sidewalk += measured.on_sidewalk() > 0 ? 1 : 0;
        if (speed >= standing_speed)
            vehicle.least_gap = std::min(vehicle.least_gap, measured.gap_ahead());
    }

    void add(const world::Event& event) {
        ++result.events;
        learn_name(event);
        if (event.kind() != world::EventKind::collision)
            return;
        ++result.collisions;
        for (const std::uint32_t id : {event.actor(), event.other()})
            if (id != 0)
                ++vehicles_[id].result.collisions;
    }

    std::map<std::uint32_t, Count> vehicles_;
};

}  // namespace

TraceStatistics statistics(TraceReader& trace,
                           std::optional<std::uint64_t> first,
                           std::optional<std::uint64_t> last) {
    require_kept(trace, "vehicles");
    Counter counter;
    for (std::uint64_t index = trace.first(); index <= last.value_or(trace.last()); ++index) {
        const RecordedTick tick = trace.recorded(index);
        if (index < first.value_or(trace.first()))
            counter.learn_names(tick.view);
        else
            counter.add(tick);
    }
    return counter.finish();
}

}  // namespace reprise::replay

#include "render/sensors.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "render/observer.h"
#include "render/trace/default_float_mode.h"
#include "world/check.h"

namespace reprise::render {

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

}  // namespace reprise::render

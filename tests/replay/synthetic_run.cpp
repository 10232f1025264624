#include "tests/replay/synthetic_run.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <unistd.h>

#include "replay/chain_seed.h"
#include "replay/trace_writer.h"
#include "tests/support/worlds.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/random.h"

namespace reprise::test {

namespace {

double noise(std::uint64_t tick, std::uint64_t item) {
    return world::draw(11, tick, world::Purpose::scenario, item);
}

template <typename T>
std::uint64_t digest(const std::vector<T>& values) {
    world::Hasher hasher;
    hasher.add(std::span<const T>(values));
    return hasher.digest64();
}

void place_vehicle(world::TickDraft& draft) {
    const std::uint64_t index = draft.tick.index;
    const double x = 0.7 * static_cast<double>(index) + 1e-3 * noise(index, 0);
    draft.tick.controls.emplace_back(
        0.3, 0.0, 0.01 * noise(index, 1), 1u, std::uint16_t{0}, false, false);
    draft.tick.vehicles.push_back(vehicle_at(1, x, -1.75, 1e-3 * noise(index, 2), 14));
    for (std::uint8_t wheel = 0; wheel < 4; ++wheel)
        draft.tick.wheels.emplace_back(0.3,
                                       6.28 * noise(index, 10u + wheel),
                                       0.0,
                                       3500.0,
                                       1.0f,
                                       1u,
                                       wheel,
                                       true,
                                       std::uint8_t{0},
                                       std::uint8_t{0},
                                       0u);
    world::Measurement measurement;
    measurement.mutate_actor(1);
    measurement.mutate_speed(14 + 1e-3 * noise(index, 3));
    draft.tick.measurements.push_back(measurement);
}

void place_cars(world::TickDraft& draft, std::uint32_t cars) {
    const std::uint64_t index = draft.tick.index;
    for (std::uint32_t i = 0; i < cars; ++i) {
        const double x = std::round(1024 * (10.0 * i + 0.6 * static_cast<double>(index) +
                                            0.1 * noise(index, 100 + i))) /
                         1024;
        draft.traffic.cars.push_back(
            car_at(world::first_background_id + i, x, 1.75, 3.14159, 12 + noise(index, 5000 + i)));
    }
    draft.tick.signals.push_back(index / 50 % 2 == 0 ? world::SignalColor::red
                                                     : world::SignalColor::green);
}

void raise_events(world::TickDraft& draft) {
    world::EventT event;
    event.actor = 1;
    if (draft.tick.index == 1) {
        event.kind = world::EventKind::spawned;
        event.text = "ego";
        draft.tick.events.push_back(event);
    } else if (draft.tick.index % 40 == 0) {
        event.kind = world::EventKind::collision;
        event.value = 120.5;
        draft.tick.events.push_back(event);
    }
}

void digest_stages(world::TickDraft& draft) {
    world::Digests& digests = draft.tick.digests;
    digests.mutate_scenario(draft.tick.events.size());
    digests.mutate_controls(digest(draft.tick.controls));
    digests.mutate_traffic(digest(draft.traffic.cars));
    digests.mutate_pedestrians(digest(draft.traffic.walkers));
    digests.mutate_physics(digest(draft.tick.vehicles) ^ digest(draft.tick.wheels));
    digests.mutate_measurements(digest(draft.tick.measurements));
}

}  // namespace

world::Recording recording(std::uint64_t seed) {
    world::Recording recording;
    recording.episode = episode("spawn{ model = 'sedan' }\nfinish('arrived')\n");
    recording.episode.seed = seed;
    recording.town = straight_road_with_signal();
    recording.network = "<net version=\"1.16\"/>";
    return recording;
}

Change at(std::uint64_t tick, Change change) {
    return [=](world::TickDraft& draft) {
        if (draft.tick.index == tick)
            change(draft);
    };
}

std::vector<world::SealedTick> drive(const SyntheticRun& run) {
    std::vector<world::SealedTick> ticks;
    world::Digest128 chain = replay::chain_seed(recording(run.seed));
    for (std::uint64_t index = 1; index <= run.ticks; ++index) {
        world::TickDraft draft;
        draft.tick.index = index;
        draft.tick.road_friction = 1;
        place_vehicle(draft);
        place_cars(draft, run.cars);
        raise_events(draft);
        digest_stages(draft);
        if (run.change)
            run.change(draft);
        ticks.push_back(world::seal(draft, chain));
        chain = ticks.back().view().tick->digests()->chain();
    }
    return ticks;
}

void write_trace(const std::filesystem::path& path, const SyntheticRun& run) {
    const world::Recording start = recording(run.seed);
    replay::TraceWriter writer(path, start);
    for (const world::SealedTick& tick : drive(run))
        writer.append(tick);
    writer.close({"passed", "finished at line 2: arrived", run.ticks});
}

replay::RecordedTick as_recorded(const world::SealedTick& tick) {
    return {tick.view(), tick.tick_bytes(), tick.traffic_bytes()};
}

TickBytes bytes_of(const replay::RecordedTick& tick) {
    return {{tick.tick_bytes.begin(), tick.tick_bytes.end()},
            {tick.traffic_bytes.begin(), tick.traffic_bytes.end()}};
}

TickBytes bytes_of(const world::SealedTick& tick) {
    return bytes_of(as_recorded(tick));
}

std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_file(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
    // A new file each time: some file systems flush a file that is cut to nothing and written
    // again.
    std::filesystem::remove(path);
    std::ofstream out(path, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
}

Folder::Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "reprise_test_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
        throw std::runtime_error("no temporary folder");
    path_ = name;
}

Folder::~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string error_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const world::Error& error) {
        return error.what();
    }
    return "";
}

}  // namespace reprise::test

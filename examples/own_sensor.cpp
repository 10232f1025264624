// A sensor of one's own, over a trace: an ultrasonic parking aid with four cones in the rear
// bumper. Rays say what is there; what a sensor makes of it is up to it. usage: own_sensor T.mcap
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "render/sensors.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/models/actors.h"

using namespace reprise;

namespace {

constexpr double reach = 4;                           // [m]
constexpr double cone = 30 * std::numbers::pi / 180;  // to each side
constexpr int rays = 15;                              // across, and as many upwards

/// The nearest surface that sends sound back: one that slants too far does not.
double nearest_echo(const std::vector<render::ProbeEcho>& echoes,
                    const std::vector<render::Probe>& probes) {
    double nearest = reach;
    for (std::size_t i = 0; i < echoes.size(); ++i)
        if (echoes[i].normal.dot(-probes[i].direction) > 0.5)
            nearest = std::min(nearest, echoes[i].distance);
    return nearest;
}

std::vector<render::Probe> cone_of(const Eigen::Isometry3d& pose_world_sensor) {
    std::vector<render::Probe> probes;
    for (int up = 0; up < rays; ++up)
        for (int across = 0; across < rays; ++across) {
            const double yaw = cone * (2.0 * across / (rays - 1) - 1);
            const double pitch = cone / 3 * (2.0 * up / (rays - 1) - 1);
            const Eigen::Vector3d ray(std::cos(yaw), std::sin(yaw), std::tan(pitch));
            probes.push_back(
                {pose_world_sensor.translation(), pose_world_sensor.linear() * ray.normalized()});
        }
    return probes;
}

void show(const char* path) {
    replay::TraceReader trace(path);
    render::Sensors sensors(trace.recording().town);
    for (std::uint64_t index = trace.first(); index <= trace.last(); index += 20) {
        const world::TickView tick = trace.tick(index).view;
        if (tick.vehicles().empty())
            continue;
        const std::uint32_t ego = tick.vehicles().front().id();
        const world::Extent extent = *world::find_extent(tick, ego);
        std::printf("tick %6llu ", static_cast<unsigned long long>(index));
        for (const double y : {0.6, 0.2, -0.2, -0.6}) {
            Eigen::Isometry3d sensor = *world::find_pose(tick, ego);
            sensor.translate(Eigen::Vector3d(extent.rear, y, 0.5));
            sensor.rotate(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitZ()));
            const auto probes = cone_of(sensor);
            std::printf(" %5.2f m", nearest_echo(sensors.probe(tick, probes, reach, ego), probes));
        }
        std::printf("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        show(argc > 1 ? argv[1] : "trace.mcap");
    } catch (const world::Error& error) {
        std::fprintf(stderr, "own_sensor: %s\n", error.what());
        return 2;
    }
}

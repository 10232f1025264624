// scene_export OUT [TICKS]: the geometry of Town 1 with 100 cars and 50 walkers as a camera on the
// first vehicle finds it, for another renderer (tests/peers/beside_cycles.py), and the CPU time
// that our own picture of it takes on one core. OUT.json says where in OUT.bin things are:
// little-endian float32 vertices [m] and uint32 triangles of each prototype; instances by
// prototype and pose (12 numbers, rows of a 3 x 4 matrix to the scene's frame).
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "kernel/kernel.h"
#include "render/look/sky.h"
#include "render/scene/scene.h"
#include "render/sensors.h"
#include "render/trace/camera.h"
#include "tests/bench/drive.h"
#include "tests/bench/timer.h"
#include "world/frames.h"
#include "world/models/viewpoint.h"
#include "world/weather/weather.h"

namespace {

using namespace reprise;

/// Adds the prototype's mesh to the file, once.
class Prototypes {
  public:
    explicit Prototypes(const std::string& path) : file_(path, std::ios::binary) {}

    std::size_t number_of(const render::Prototype& prototype) {
        const auto [at, added] = numbers_.try_emplace(&prototype, numbers_.size());
        if (added) {
            const render::Mesh& mesh = prototype.mesh;
            meshes.push_back(
                {{"vertices", mesh.vertices.size()}, {"triangles", mesh.triangles.size()}});
            write(mesh.vertices);
            write(mesh.triangles);
        }
        return at->second;
    }

    nlohmann::json meshes = nlohmann::json::array();

  private:
    template <typename T>
    void write(const std::vector<T>& values) {
        static_assert(sizeof(T) == 12);
        file_.write(reinterpret_cast<const char*>(values.data()),
                    static_cast<std::streamsize>(values.size() * sizeof(T)));
    }

    std::ofstream file_;
    std::map<const render::Prototype*, std::size_t> numbers_;
};

nlohmann::json rows_of(const Eigen::Affine3d& pose) {
    nlohmann::json rows = nlohmann::json::array();
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column)
            rows.push_back(pose(row, column));
    return rows;
}

world::SensorSpec camera_of(const world::TickView& tick) {
    world::SensorSpec spec;
    spec.name = "camera";
    spec.actor = tick.vehicles().front().id();
    return spec;
}

double picture_ms(const world::TownT& town, const world::TickView& tick) {
    render::Sensors sensors(town, {.threads = 1});
    const world::Weather& weather = world::find_weather("clear_noon")->weather;
    bench::ThreadTimer timer;
    sensors.observe(tick, {camera_of(tick)}, weather);
    for (int turn = 0; turn < 7; ++turn)
        timer.time([&] { sensors.observe(tick, {camera_of(tick)}, weather); });
    return 1e3 * timer.median();
}

}  // namespace

int main(int count, char** words) {
    if (count < 2) {
        std::cerr << "usage: scene_export OUT [TICKS]\n";
        return 2;
    }
    const std::string out = words[1];
    const int ticks = count > 2 ? std::atoi(words[2]) : 300;
    world::Recording recording = bench::free_drive(100);
    recording.episode.walkers = 50;
    kernel::Kernel kernel(recording);
    const world::SealedTick* sealed = nullptr;
    for (int i = 0; i < ticks; ++i)
        sealed = &kernel.step();
    const world::TickView tick = sealed->view();

    const render::TownScene town(recording.town, false);
    render::Scene scene(town);
    scene.place(tick, {});
    Prototypes prototypes(out + ".bin");
    nlohmann::json instances = nlohmann::json::array();
    const std::uint32_t own = camera_of(tick).actor;  // cameras do not see their carrier
    for (const auto all : {town.instances(), scene.moving()})
        for (const render::Instance& instance : all)
            if (instance.actor != own)
                instances.push_back({{"prototype", prototypes.number_of(*instance.prototype)},
                                     {"pose", rows_of(instance.pose)}});

    const world::SensorSpec spec = camera_of(tick);
    Eigen::Isometry3d pose = *world::find_pose(tick, own);
    pose.translation() -= town.origin();
    const render::Sky sky(world::find_weather("clear_noon")->weather);
    const Eigen::Vector3f sun = sky.to_sun();
    const nlohmann::json scene_json{
        {"prototypes", prototypes.meshes},
        {"instances", instances},
        {"camera",
         {{"vehicle", rows_of(Eigen::Affine3d(pose))},
          {"mount", {spec.position.x(), spec.position.y(), spec.position.z()}},
          {"fov", spec.fov},
          {"width", spec.width},
          {"height", spec.height}}},
        {"to_sun", {sun.x(), sun.y(), sun.z()}},
        {"picture_ms", picture_ms(recording.town, tick)}};
    std::ofstream(out + ".json") << scene_json;
    return 0;
}

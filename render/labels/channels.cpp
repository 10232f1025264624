#include "render/labels/channels.h"

#include <cstring>
#include <limits>

#include <tbb/parallel_for.h>

#include "render/trace/default_float_mode.h"
#include "world/external/instance_id.h"

namespace reprise::render {

namespace {

template <typename Value>
void put(std::vector<std::uint8_t>& bytes, std::size_t index, const Value& value) {
    std::memcpy(bytes.data() + index * sizeof(Value), &value, sizeof(Value));
}

}  // namespace

std::vector<std::uint8_t> depth_bytes(const std::vector<Hit>& hits) {
    std::vector<std::uint8_t> bytes(hits.size() * sizeof(float));
    for (std::size_t i = 0; i < hits.size(); ++i)
        put(bytes,
            i,
            hits[i].instance == no_instance ? std::numeric_limits<float>::infinity()
                                            : hits[i].distance);
    return bytes;
}

std::vector<std::uint8_t> class_bytes(const Scene& scene, const std::vector<Hit>& hits) {
    std::vector<std::uint8_t> bytes(hits.size());
    for (std::size_t i = 0; i < hits.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>(semantic_class(scene, hits[i]));
    return bytes;
}

std::uint16_t instance_number(const Scene& scene, const Hit& hit) {
    if (hit.instance == no_instance)
        return 0;
    const Instance& instance = scene.instance(hit.instance);
    if (instance.actor != 0)
        return world::instance_of_actor(instance.actor);
    const std::uint32_t thing = scene.town().thing_of(instance, hit.triangle);
    return thing == 0 ? std::uint16_t{0} : world::instance_of_thing(thing - 1);
}

std::vector<std::uint8_t> instance_bytes(const Scene& scene, const std::vector<Hit>& hits) {
    std::vector<std::uint8_t> bytes(hits.size() * sizeof(std::uint16_t));
    for (std::size_t i = 0; i < hits.size(); ++i)
        put(bytes, i, instance_number(scene, hits[i]));
    return bytes;
}

std::vector<std::uint8_t> normal_bytes(const Scene& scene,
                                       const Camera& camera,
                                       const std::vector<Hit>& hits) {
    std::vector<std::uint8_t> bytes(hits.size() * sizeof(Eigen::Vector3f));
    const Eigen::Vector3f eye = camera.position().cast<float>();
    const Eigen::Matrix3f to_camera = camera.rotation_scene_camera().transpose().cast<float>();
    const auto pixel = static_cast<float>(camera.pixel());
    tbb::parallel_for(0, camera.height(), [&](int y) {
        const DefaultFloatMode plain;
        Surfaces surfaces(scene, eye, pixel);
        for (int x = 0; x < camera.width(); ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width()) +
                           static_cast<std::size_t>(x);
            Eigen::Vector3f normal = Eigen::Vector3f::Zero();
            if (hits[i].instance != no_instance) {
                const Eigen::Vector3f ray = camera.ray(x + 0.5, y + 0.5).cast<float>();
                normal = to_camera * surfaces.at(hits[i], ray).normal;
            }
            put(bytes, i, normal);
        }
    });
    return bytes;
}

}  // namespace reprise::render

#include "render/trace/portable_tracer.h"

#include <deque>
#include <limits>
#include <tuple>

#include <gmock/gmock.h>

#include "render/scene/tracer.h"
#include "world/random.h"

namespace reprise::render {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr float infinite = std::numeric_limits<float>::infinity();

/// The same numbers on every run.
class Numbers {
  public:
    double next(double low, double high) {
        return low + (high - low) * world::draw(7, 0, world::Purpose::camera_noise, count_++);
    }

    Vector3d point(double reach) {
        const double x = next(-reach, reach);
        const double y = next(-reach, reach);
        return {x, y, next(-reach, reach)};
    }

  private:
    std::uint64_t count_ = 0;
};

/// Some meshes in many places.
struct World {
    std::deque<Prototype> prototypes;
    std::vector<Instance> instances;

    const Prototype& add(Mesh mesh) {
        auto tree = std::make_unique<MeshTree>(mesh);
        return prototypes.emplace_back(Prototype{std::move(mesh), nullptr, std::move(tree)});
    }

    Instance& place(const Prototype& prototype) {
        Instance& instance = instances.emplace_back();
        instance.prototype = &prototype;
        return instance;
    }
};

Mesh crumbs(Numbers& numbers, int count) {
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const Vector3d centre = numbers.point(10);
        for (int corner = 0; corner < 3; ++corner)
            add_vertex(mesh, (centre + numbers.point(4)).cast<float>());
        const auto first = static_cast<std::uint32_t>(3 * i);
        add_triangle(mesh, first, first + 1, first + 2, {Material::skin});
    }
    return mesh;
}

/// Random triangles, some turned, moved, scaled, or for some rays only.
World crumbled_world(Numbers& numbers) {
    World world;
    world.place(world.add(crumbs(numbers, 200)));
    const Prototype& small = world.add(crumbs(numbers, 30));
    for (int i = 0; i < 12; ++i) {
        Instance& instance = world.place(small);
        instance.mask = i % 3 == 0 ? 2U : 1U;
        instance.pose.translate(numbers.point(15));
        instance.pose.rotate(Eigen::AngleAxisd(numbers.next(0, 6), numbers.point(1).normalized()));
        instance.pose.scale(Vector3d(numbers.next(.2, 1), numbers.next(.2, 1), 1));
    }
    return world;
}

std::vector<Ray> rays_about(Numbers& numbers, std::size_t count, float far) {
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        Vector3f direction = numbers.point(1).cast<float>();
        if (i % 5 == 0)
            direction = Vector3f(0, i % 2 == 0 ? 1 : -1, 0);  // along the sides of boxes
        rays.push_back({numbers.point(12).cast<float>(), direction, far, i % 4 == 0 ? 1U : 3U});
    }
    return rays;
}

/// Distance along the ray by solving for it with Eigen, in the scene's frame; infinite: no
/// found.
double crossed_at(const Instance& instance, std::size_t triangle, const Ray& ray) {
    const Mesh& mesh = instance.prototype->mesh;
    std::array<Vector3d, 3> p;
    for (std::size_t corner = 0; corner < 3; ++corner)
        p[corner] =
            instance.pose * mesh.vertices[mesh.triangles[triangle][corner]].cast<double>().eval();
    Eigen::Matrix3d columns;
    columns << p[1] - p[0], p[2] - p[0], -ray.direction.cast<double>();
    const Vector3d uvt = columns.fullPivLu().solve(ray.origin.cast<double>() - p[0]);
    const bool inside = uvt.x() >= 0 && uvt.y() >= 0 && uvt.x() + uvt.y() <= 1 && uvt.z() > 0;
    return inside ? uvt.z() : std::numeric_limits<double>::infinity();
}

/// Everything is looked at.
std::tuple<double, std::uint32_t, std::uint32_t> nearest_of_all(const World& world,
                                                                const Ray& ray) {
    std::tuple<double, std::uint32_t, std::uint32_t> best(
        std::numeric_limits<double>::infinity(), no_instance, 0);
    for (std::uint32_t i = 0; i < world.instances.size(); ++i) {
        const Instance& instance = world.instances[i];
        for (std::uint32_t k = 0; k < instance.prototype->mesh.triangles.size(); ++k)
            if ((instance.mask & ray.mask) != 0)
                best = std::min(best, std::tuple(crossed_at(instance, k, ray), i, k));
    }
    return std::get<0>(best) < static_cast<double>(ray.far)
               ? best
               : std::tuple(std::numeric_limits<double>::infinity(), no_instance, 0U);
}

/// A square of two triangles across the x axis.
Mesh square(float x) {
    Mesh mesh;
    add_quad(mesh,
             {Vector3f(x, -1, -1), Vector3f(x, -1, 1), Vector3f(x, 1, 1), Vector3f(x, 1, -1)},
             {Material::skin});
    return mesh;
}

Hit single(const PortableTracer& tracer, const Ray& ray) {
    Hit hit;
    tracer.trace_nearest({&ray, 1}, {&hit, 1});
    return hit;
}

TEST(PortableTracer, FindsWhatLookingAtEverythingFinds) {
    Numbers numbers;
    const World world = crumbled_world(numbers);
    const PortableTracer tracer(world.instances);
    for (const float far : {infinite, 12.0F}) {
        const std::vector<Ray> rays = rays_about(numbers, 403, far);  // no multiple of a packet
        std::vector<Hit> hits(rays.size());
        std::vector<std::uint8_t> free(rays.size());
        tracer.trace_nearest(rays, hits);
        tracer.trace_visibility(rays, free);
        std::size_t met = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const auto [distance, instance, triangle] = nearest_of_all(world, rays[i]);
            EXPECT_EQ(hits[i].instance, instance) << i;
            EXPECT_EQ(free[i] != 0, instance == no_instance) << i;
            if (instance == no_instance || hits[i].instance != instance)
                continue;
            ++met;
            EXPECT_EQ(hits[i].triangle, triangle) << i;
            EXPECT_NEAR(static_cast<double>(hits[i].distance), distance, 1e-6 * distance) << i;
        }
        EXPECT_GT(met, rays.size() / 10);
        EXPECT_LT(met, rays.size());
    }
}

TEST(PortableTracer, AnswersDoNotDependOnTheOtherRaysOfAPacket) {
    Numbers numbers;
    const World world = crumbled_world(numbers);
    const PortableTracer tracer(world.instances);
    const std::vector<Ray> rays = rays_about(numbers, 64, infinite);
    std::vector<Hit> hits(rays.size());
    tracer.trace_nearest(rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Hit alone = single(tracer, rays[i]);
        EXPECT_EQ(
            std::tuple(alone.distance, alone.instance, alone.triangle, alone.u, alone.v),
            std::tuple(hits[i].distance, hits[i].instance, hits[i].triangle, hits[i].u, hits[i].v))
            << i;
    }
}

TEST(PortableTracer, OfThingsEquallyFarTheFirstIsMet) {
    World world;
    const Prototype& same = world.add(square(0));
    for (const double x : {9, 5, 5, 5})
        world.place(same).pose.translate(Vector3d(x, 0, 0));
    // From both sides, so that the order of looking cannot decide.
    for (const float from : {0.0F, 8.0F}) {
        const Ray ray{{from, .25F, .25F}, {from < 5 ? 1.0F : -1.0F, 0, 0}, infinite, ~0U};
        const Hit hit = single(PortableTracer(world.instances), ray);
        EXPECT_EQ(hit.instance, 1U);
        EXPECT_EQ(hit.distance, from < 5 ? 5.0F : 3.0F);
    }
    // The edge between a square's two triangles belongs to both.
    const Hit edge = single(PortableTracer(world.instances), {{0, 0, 0}, {1, 0, 0}, infinite, ~0U});
    EXPECT_EQ(edge.instance, 1U);
    EXPECT_EQ(edge.triangle, 0U);
}

TEST(PortableTracer, MeetsNothingWhereThereIsNothing) {
    World world;
    const Ray ray{{0, 0, 0}, {1, 0, 0}, infinite, ~0U};
    EXPECT_EQ(single(PortableTracer(world.instances), ray).instance, no_instance);
    world.place(world.add(Mesh{}));
    EXPECT_EQ(single(PortableTracer(world.instances), ray).instance, no_instance);
    world.place(world.add(square(5))).mask = 4;
    EXPECT_EQ(
        single(PortableTracer(world.instances), {ray.origin, ray.direction, infinite, 3U}).instance,
        no_instance);
    EXPECT_EQ(
        single(PortableTracer(world.instances), {ray.origin, ray.direction, 4.9F, ~0U}).instance,
        no_instance);
    const float none = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(single(PortableTracer(world.instances), {{none, 0, 0}, ray.direction, infinite, ~0U})
                  .instance,
              no_instance);
    EXPECT_EQ(single(PortableTracer(world.instances), ray).instance, 1U);
}

}  // namespace
}  // namespace reprise::render

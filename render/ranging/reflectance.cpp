#include "render/ranging/reflectance.h"

#include <algorithm>
#include <cmath>

#include "render/look/car_surface_point.h"
#include "render/shapes/buildings/building_plan.h"
#include "render/shapes/street/prop_mesh.h"

namespace reprise::render {

namespace {

/// Glass lets pulses through or mirrors them away; nothing behind it is seen (not modelled).
constexpr Reflectance glass{0.01F, 0, false};
constexpr Reflectance cloth{0.5F, 0.4F, false};  // in the near infrared of whatever colour
constexpr Reflectance leaves{0.45F, 0.5F, false};

bool is_car_glass(const Scene& scene, const Echo& echo, const Mesh& mesh) {
    const CarShape& shape = scene.car_shape(echo.instance->model);
    const std::array<std::uint32_t, 3>& corners = mesh.triangles[echo.hit.triangle];
    const Eigen::Vector3f& a = mesh.vertices[corners[0]];
    const Eigen::Vector3f to_b = mesh.vertices[corners[1]] - a;
    const Eigen::Vector3f to_c = mesh.vertices[corners[2]] - a;
    const Eigen::Vector3f p = a + echo.hit.u * to_b + echo.hit.v * to_c;
    return is_glass(car_surface_point(shape, p, to_b.cross(to_c).normalized()));
}

Reflectance of_car_body(const Scene& scene, const Echo& echo, const Mesh& mesh) {
    if (is_car_glass(scene, echo, mesh))
        return glass;
    // Paint of the near infrared is between its colour and a primer's grey.
    return {0.08F + 0.75F * luminance(echo.instance->color), 0.15F, false};
}

Reflectance of_prop(const PropTag& tag) {
    switch (tag.finish) {
        case PropFinish::plate:
            return {4, 0, false};  // a sheet of glass beads or prisms
        case PropFinish::glass:
            return glass;
        case PropFinish::water:
            return {0.02F, 0, false};
        case PropFinish::foliage:
            return leaves;
        case PropFinish::iron:
            return {0.1F, 0.2F, false};
        case PropFinish::steel:
        case PropFinish::plate_back:
        case PropFinish::lamp:
            return {0.35F, 0.2F, false};
        default:
            return {0.4F, 0.4F, false};
    }
}

Reflectance of_plot(world::PlotKind kind) {
    switch (kind) {
        case world::PlotKind::water:
            return {0.02F, 0, false};
        case world::PlotKind::gravel:
        case world::PlotKind::playground:
            return {0.35F, 0.5F, false};
        case world::PlotKind::square:
        case world::PlotKind::car_park:
            return {0.25F, 0.5F, true};
        default:
            return leaves;
    }
}

}  // namespace

Reflectance reflectance_of(const Scene& scene, const Echo& echo) {
    const Mesh& mesh = echo.instance->prototype->mesh;
    const std::uint32_t tag = mesh.tags[echo.hit.triangle];
    Material material = mesh.materials[echo.hit.triangle];
    if (material == Material::of_instance)
        material = echo.instance->material;
    switch (material) {
        case Material::grass:
        case Material::leaf:
            return leaves;
        case Material::asphalt:
            return {0.17F, 0.5F, true};
        case Material::pavement:
        case Material::kerb:
            return {0.30F, 0.5F, true};
        case Material::marking:
            return {0.75F, 0.5F, true};  // glass beads in the paint
        case Material::facade:
        case Material::wall:
        case Material::building:
            return {0.4F, 0.4F, false};
        case Material::roof:
            return {0.3F, 0.4F, false};
        case Material::prop:
            return of_prop(PropTag::of(tag));
        case Material::plot:
            return of_plot(scene.plots()[tag].kind);
        case Material::thing:
            return {0.5F, 0.2F, false};
        case Material::bark:
            return {0.35F, 0.5F, false};
        case Material::pole:
            return {0.35F, 0.2F, false};
        case Material::signal_case:
        case Material::signal_lamp:
            return {0.1F, 0.1F, false};
        case Material::car_body:
            return of_car_body(scene, echo, mesh);
        case Material::car_cargo:
            return {0.6F, 0.2F, false};
        case Material::car_under:
        case Material::wheel:
            return {0.05F, 0.4F, false};
        case Material::car_part:
            return {0.2F, 0.2F, false};
        case Material::skin:
            return {0.55F, 0.3F, false};
        case Material::hair:
        case Material::eye:
            return {0.2F, 0.4F, false};
        default:
            return cloth;
    }
}

float returned_share(const Reflectance& surface, float cosine, float wetness) {
    const float squared = surface.roughness * surface.roughness;
    const float a = 1 - 0.5F * squared / (squared + 0.33F);
    const float b = 0.45F * squared / (squared + 0.09F);
    const float dry = surface.diffuse * (a * cosine + b * (1 - cosine * cosine));
    if (!surface.soaks || !(wetness > 0))
        return dry;
    // Into the film, back out of it, and back in for what the film's underside mirrors.
    constexpr float n = 1.33F;
    constexpr float f0 = 0.0201F;             // ((n - 1) / (n + 1))^2
    constexpr float mirrored_inside = 0.48F;  // of diffuse light below the film
    const float through = 1 - fresnel(f0, cosine);
    const float film =
        through * through / (n * n) * dry / (1 - std::min(surface.diffuse, 1.0F) * mirrored_inside);
    return mix(dry, film, wetness);
}

float radar_share(const Scene& scene, const Echo& echo) {
    const Mesh& mesh = echo.instance->prototype->mesh;
    Material material = mesh.materials[echo.hit.triangle];
    if (material == Material::of_instance)
        material = echo.instance->material;
    constexpr float metal = 5;
    switch (material) {
        case Material::car_body:
            return is_car_glass(scene, echo, mesh) ? 0.5F : metal;
        case Material::car_cargo:
        case Material::car_under:
        case Material::car_part:
        case Material::wheel:
        case Material::pole:
        case Material::signal_case:
            return metal;
        case Material::prop: {
            const PropFinish finish = PropTag::of(mesh.tags[echo.hit.triangle]).finish;
            const bool of_metal = finish == PropFinish::steel || finish == PropFinish::iron ||
                                  finish == PropFinish::plate || finish == PropFinish::plate_back;
            return of_metal ? metal : 1;
        }
        case Material::facade:
        case Material::wall:
        case Material::building:
        case Material::roof:
            return 1;
        case Material::asphalt:
        case Material::pavement:
        case Material::kerb:
        case Material::marking:
        case Material::grass:
        case Material::plot:
            return 0.02F;
        case Material::leaf:
        case Material::bark:
            return 0.2F;
        default:
            return 0.6F;  // people
    }
}

}  // namespace reprise::render

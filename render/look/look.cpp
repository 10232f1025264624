#include "render/look/look.h"

#include <cmath>

#include "render/look/lamp_colors.h"
#include "render/shapes/noise.h"
#include "render/shapes/street/thing_mesh.h"
#include "render/trace/prefetch.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::SemanticClass;

Look leaf_look(const Surface& at) {
    Look look;
    const std::uint32_t kind = at.instance->model;
    const float hue = unit(hash(kind, 5));
    const float own = unit(hash(at.tag, 6));
    const Color green = mix(Color(.060F, .115F, .024F), Color(.115F, .135F, .028F), hue);
    const float patch =
        value_noise(at.position.x() * 0.9F, at.position.y() * 0.9F + at.position.z(), 8);
    look.albedo = green * (0.65F + 0.5F * own + 0.35F * patch);
    if (at.tag == 0)
        look.albedo *= 0.42F;
    look.translucency = at.tag == 0 ? 0 : 0.45F;
    look.f0 = 0.02F;
    return look;
}

Look bark_look(const Surface& at) {
    Look look;
    const float grain =
        value_noise(at.position.x() * 14 + at.position.y() * 11, at.position.z() * 3);
    look.albedo = Color(.13F, .10F, .075F) * (0.6F + 0.7F * grain * detail(at, 0.1F));
    return look;
}

Look signal_lamp_look(const ShadingInput& input, const Surface& at) {
    using world::SignalColor;
    const std::uint32_t index = at.tag / 4;
    const auto lamp = static_cast<SignalLamp>(at.tag % 4);
    const auto signals = input.scene.signals();
    const SignalColor color = index < signals.size() ? signals[index] : SignalColor::off;
    bool lit = false;
    Color light = Color::Zero();
    switch (lamp) {
        case SignalLamp::red:
            lit = color == SignalColor::red || color == SignalColor::red_yellow ||
                  color == SignalColor::stop;
            light = lens_red;
            break;
        case SignalLamp::yellow:
            lit = color == SignalColor::yellow || color == SignalColor::red_yellow;
            light = lens_amber;
            break;
        case SignalLamp::turn:
            lit = color == SignalColor::green;
            light = lens_green;
            break;
        case SignalLamp::green:
            lit = color == SignalColor::green || color == SignalColor::green_minor;
            light = lens_green;
            break;
    }
    Look look;
    look.albedo = light * 0.05F + 0.01F;
    look.f0 = 0.05F;
    // Lenses are made so that a low sun does not seem to light them (EN 12368: phantom signals).
    look.roughness = 0.8F;
    if (lit)
        // Lamps outshine what is lit by day: set against the exposure, not the sun.
        look.emission = light * (5.5F / input.sky.exposure());
    return look;
}

/// Nobody has switched a parked car's lamps on, and its number plate comes from its look.
Look parked_look(const ShadingInput& input, const Surface& at) {
    Instance named = *at.instance;
    named.actor = at.instance->look;
    Surface own = at;
    own.instance = &named;
    Look look = car_look(input, own);
    look.emission = Color::Zero();
    return look;
}

/// As screens show a colour, to what a surface of it reflects.
float linear(std::uint32_t byte) {
    const float value = static_cast<float>(byte & 0xffU) / 255;
    return value * value * (0.7F + 0.3F * value);  // within 0.02 of sRGB's curve
}

Look thing_look(const Surface& at) {
    Look look;
    if (at.tag == instance_paint) {
        look.albedo = at.instance->color;
        look.roughness = 0.3F;
        look.f0 = 0.04F;
        return look;
    }
    look.albedo = 0.85F * Color(linear(at.tag >> 16U), linear(at.tag >> 8U), linear(at.tag));
    const float grain = value_noise(at.local.x() * 23 + at.local.z() * 31, at.local.y() * 27);
    look.albedo *= 1 + 0.12F * (grain - 0.5F) * detail(at, 0.05F);
    look.roughness = 0.6F;
    look.f0 = 0.03F;
    return look;
}

Look bare_look(const ShadingInput& input, const Surface& at);

Look metal_look(const Surface& at) {
    Look look;
    look.albedo =
        at.material == Material::pole ? Color(.16F, .17F, .17F) : Color(.022F, .024F, .023F);
    // Cases are dull, and the more so the longer they hang there.
    look.roughness = at.material == Material::pole ? 0.35F : 0.8F;
    look.f0 = 0.05F;
    return look;
}

}  // namespace

void Surfaces::take_facet(const Hit& hit) {
    const Instance& instance = scene_.instance(hit.instance);
    const Mesh& mesh = instance.prototype->mesh;
    const std::array<std::uint32_t, 3>& corners = mesh.triangles[hit.triangle];
    facet_.number = hit.instance;
    facet_.triangle = hit.triangle;
    facet_.instance = &instance;
    for (std::size_t i = 0; i < 3; ++i)
        facet_.corners[i] = mesh.vertices[corners[i]];
    facet_.material = mesh.materials[hit.triangle];
    if (facet_.material == Material::of_instance)
        facet_.material = instance.material;
    facet_.tag = mesh.tags[hit.triangle];
    facet_.smooth = mesh.normals.empty() ? nullptr : &mesh.normals[hit.triangle];
    const Vector3f flat =
        (facet_.corners[1] - facet_.corners[0]).cross(facet_.corners[2] - facet_.corners[0]);
    facet_.local_normal = flat.normalized();
    facet_.flat =
        instance.moved ? (instance.normal_to_scene * flat).normalized() : facet_.local_normal;
    facet_.normal = facet_.local_normal;
    if (instance.moved)
        facet_.normal = instance.normal_to_scene * facet_.local_normal;
    facet_.normal.normalize();
}

void Surfaces::expect(const Hit& hit) const {
    if (hit.instance == no_instance || hit.triangle == facet_.triangle)
        return;
    const Mesh& mesh = scene_.instance(hit.instance).prototype->mesh;
    prefetch(&mesh.triangles[hit.triangle]);
    prefetch(&mesh.materials[hit.triangle]);
    prefetch(&mesh.tags[hit.triangle]);
    if (!mesh.normals.empty())
        prefetch(&mesh.normals[hit.triangle]);
}

void Surfaces::expect_corners(const Hit& hit) const {
    if (hit.instance == no_instance || hit.triangle == facet_.triangle)
        return;
    const Mesh& mesh = scene_.instance(hit.instance).prototype->mesh;
    for (const std::uint32_t corner : mesh.triangles[hit.triangle])
        prefetch(&mesh.vertices[corner]);
}

Surface Surfaces::at(const Hit& hit, const Vector3f& direction) {
    if (hit.instance != facet_.number || hit.triangle != facet_.triangle)
        take_facet(hit);
    const float first = 1 - hit.u - hit.v;
    // In registers: who writes a vector down and reads it at once waits until it has arrived.
    const auto weighted = [&](const std::array<Vector3f, 3>& corners) __attribute__((always_inline))
                              ->Vector3f {
        return first * corners[0] + hit.u * corners[1] + hit.v * corners[2];
    };
    Surface at;
    at.instance = facet_.instance;
    at.material = facet_.material;
    at.tag = facet_.tag;
    at.position = eye_ + hit.distance * direction;
    at.local = weighted(facet_.corners);
    const float length = direction.norm();
    at.view = direction / length;
    at.distance = hit.distance * length;
    at.flat = facet_.flat;
    if (facet_.smooth == nullptr) {
        at.local_normal = facet_.local_normal;
        at.normal = facet_.normal;
    } else {
        at.local_normal = weighted(*facet_.smooth).normalized();
        at.normal = at.local_normal;
        if (at.instance->moved)
            at.normal = at.instance->normal_to_scene * at.local_normal;
        at.normal.normalize();
    }
    if (at.flat.dot(at.view) > 0)
        at.flat = -at.flat;
    if (at.normal.dot(at.flat) < 0)
        at.normal = -at.normal;
    at.footprint = at.distance * pixel_ / std::max(0.03F, -at.flat.dot(at.view));
    return at;
}

void expose(const ShadingInput& input, Surface& at) {
    const world::Weather& weather = input.sky.weather();
    if (weather.wetness() <= 0 && weather.snow_cover() <= 0)
        return;
    // Walls are looked at from before them: eaves keep little dry, a passage does.
    const float aside = 0.9F * (1 - std::abs(at.flat.z())) + 0.02F;
    const float open = input.scene.town().shelter().openness(at.position + aside * at.flat);
    at.wetness = weather.wetness() * open;
    at.snow = weather.snow_cover() * open;
}

Look shade_surface(const ShadingInput& input, const Surface& at) {
    Look look = bare_look(input, at);
    lay_snow(look, input, at);
    return look;
}

namespace {

Look bare_look(const ShadingInput& input, const Surface& at) {
    Look look;
    switch (at.material) {
        case Material::grass:
        case Material::asphalt:
        case Material::pavement:
        case Material::kerb:
        case Material::deck:
        case Material::marking:
            return ground_look(input, at);
        case Material::facade:
        case Material::roof:
            return building_look(input, at);
        case Material::car_body:
        case Material::car_cargo:
        case Material::car_under:
            return at.instance->kind == Kind::parked ? parked_look(input, at) : car_look(input, at);
        case Material::wheel:
            return wheel_look(input, at);
        case Material::wall:
        case Material::building:
            return model_building_look(input, at);
        case Material::prop:
            return prop_look(input, at);
        case Material::plot:
            return plot_look(input, at);
        case Material::thing:
            look = thing_look(at);
            break;
        case Material::car_part:
            look = car_part_look(input, at);
            break;
        case Material::bark:
            look = at.instance->kind == Kind::plant ? plant_bark_look(at) : bark_look(at);
            break;
        case Material::leaf:
            look = at.instance->kind == Kind::plant ? plant_leaf_look(at) : leaf_look(at);
            break;
        case Material::signal_lamp:
            look = signal_lamp_look(input, at);
            break;
        case Material::pole:
        case Material::signal_case:
            look = metal_look(at);
            break;
        default:
            look = walker_look(input, at);
            look.albedo = soaked(look.albedo, 0.7F * at.wetness);
            return look;
    }
    look.normal = at.normal;
    // Soaked cloth and bark are darker; leaves shed water.
    look.albedo = soaked(look.albedo, (at.material == Material::leaf ? 0.3F : 0.7F) * at.wetness);
    return look;
}

}  // namespace

world::SemanticClass semantic_class(const Scene& scene, const Hit& hit) {
    if (hit.instance == no_instance)
        return SemanticClass::sky;
    const Instance& instance = scene.instance(hit.instance);
    switch (instance.kind) {
        case Kind::tree:
        case Kind::plant:
            return SemanticClass::vegetation;
        case Kind::pedestrian:
            return SemanticClass::pedestrian;
        case Kind::rider:
            return SemanticClass::rider;
        case Kind::thing:
            return SemanticClass::dynamic_object;
        case Kind::marking:
            return SemanticClass::road_line;
        case Kind::car_body:
        case Kind::parked:
        case Kind::wheel:
            switch (scene.car_shape(instance.model).style) {
                case world::BodyStyle::lorry:
                    return SemanticClass::truck;
                case world::BodyStyle::bus:
                    return SemanticClass::bus;
                case world::BodyStyle::motorcycle:
                    return SemanticClass::motorcycle;
                case world::BodyStyle::bicycle:
                    return SemanticClass::bicycle;
                default:
                    return SemanticClass::car;
            }
        case Kind::ground:
        case Kind::town:
        case Kind::prop:
            break;
    }
    const std::uint32_t tag = instance.prototype->mesh.tags[hit.triangle];
    switch (instance.prototype->mesh.materials[hit.triangle]) {
        case Material::prop:
            return prop_class(tag);
        case Material::plot:
            return plot_class(scene.plots()[tag].kind);
        case Material::grass:
            return SemanticClass::terrain;
        case Material::pavement:
        case Material::kerb:
            return SemanticClass::sidewalk;
        case Material::deck:
            return SemanticClass::bridge;
        case Material::marking:
            return SemanticClass::road_line;
        case Material::facade:
        case Material::roof:
        case Material::wall:
        case Material::building:
            return SemanticClass::building;
        case Material::pole:
            return SemanticClass::pole;
        case Material::signal_case:
        case Material::signal_lamp:
            return SemanticClass::traffic_light;
        default:
            return SemanticClass::road;
    }
}

}  // namespace reprise::render

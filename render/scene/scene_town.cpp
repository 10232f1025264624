#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "ground/mesh/banks.h"
#include "ground/mesh/build_ground.h"
#include "ground/paint/markings.h"
#include "render/scene/land.h"
#include "render/scene/town_scene.h"
#include "render/shapes/street/plant_mesh.h"
#include "render/shapes/street/signal_parts.h"
#include "world/external/instance_id.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

Material ground_material(ground::Surface surface) {
    switch (surface) {
        case ground::Surface::terrain:
            return Material::grass;
        case ground::Surface::sidewalk:
            return Material::pavement;
        case ground::Surface::kerb:
            return Material::kerb;
        case ground::Surface::deck:
            return Material::deck;
        case ground::Surface::marking:
            return Material::marking;
        default:
            return Material::asphalt;
    }
}

Mesh mesh_of(const ground::GroundMesh& ground, const Vector3d& origin) {
    Mesh mesh;
    for (const Vector3d& vertex : ground.vertices)
        mesh.vertices.emplace_back((vertex - origin).cast<float>());
    mesh.triangles = ground.triangles;
    for (const ground::Surface surface : ground.surfaces)
        mesh.materials.push_back(ground_material(surface));
    mesh.tags.assign(mesh.triangles.size(), 0);
    drop_degenerate(mesh);
    return mesh;
}

BuildingFrame frame_of(const world::Building& building, const Vector3d& origin) {
    return {(world::to_eigen(building.centre()) - origin).cast<float>(),
            static_cast<float>(std::cos(building.yaw())),
            static_cast<float>(std::sin(building.yaw())),
            {static_cast<float>(building.length() / 2), static_cast<float>(building.width() / 2)},
            Facade(building)};
}

}  // namespace

void TownScene::build_town(const world::TownT& town) {
    const auto add = [&](Mesh mesh, Kind kind, std::uint32_t mask) {
        Instance& instance = instances_.emplace_back();
        instance.prototype = add_prototype(std::move(mesh));
        instance.kind = kind;
        instance.mask = mask;
    };
    add(land_mesh(town, origin_), Kind::ground, solid_bit);  // the first: see shelter()
    const ground::GroundMesh levels = ground::build_ground(town);
    Mesh ground = mesh_of(levels, origin_);
    add(std::move(ground), Kind::ground, solid_bit);
    Mesh banks = mesh_of(ground::build_banks(levels), origin_);
    if (!banks.triangles.empty())
        add(std::move(banks), Kind::ground, solid_bit);
    Mesh markings = mesh_of(ground::build_markings(town), origin_);
    if (!markings.triangles.empty())
        add(std::move(markings), Kind::marking, marking_bit);

    Mesh plots = plot_mesh(town, levels, origin_);
    for (const world::PlotT& plot : town.plots)
        plots_.emplace_back(plot, origin_);
    if (!plots.triangles.empty())
        add(std::move(plots), Kind::ground, solid_bit);

    Mesh houses = build_things(town);
    if (!houses.triangles.empty())
        add(std::move(houses), Kind::town, solid_bit);
    place_trees(town);
    place_props(town);
    lamps_ = TownLamps(town, facades_, origin_);
}

/// Buildings and signals, and which triangles are of which.
Mesh TownScene::build_things(const world::TownT& town) {
    Mesh things;
    Mesh part;
    const auto finish = [&] {
        drop_degenerate(part);
        append(things, part);
        part = Mesh();
        thing_ends_.push_back(static_cast<std::uint32_t>(things.triangles.size()));
    };
    for (std::uint32_t i = 0; i < town.buildings.size(); ++i) {
        // Frames are found by the building's index, whether it has a model or not.
        buildings_.push_back(frame_of(town.buildings[i], origin_));
        if (town.buildings[i].model() == 0)
            add_building(part, town.buildings[i], i, origin_);
        else
            add_model_building(part, facades_, town.buildings[i], origin_);
        finish();
    }
    for (const world::DrawnBuildingT& building : town.drawn_buildings) {
        add_drawn_building(part, facades_, building, origin_);
        finish();
    }
    for (const world::SignalHeadT& head : town.heads) {
        add_signal_head(part, town, head, origin_);
        finish();
    }
    for (std::uint32_t i = 0; town.heads.empty() && i < town.signals.size(); ++i) {
        add_signal(part, town, i, origin_);
        finish();
    }
    return things;
}

std::uint32_t TownScene::thing_of(const Instance& instance, std::uint32_t triangle) const {
    if (instance.kind != Kind::town)
        return instance.thing;
    const auto end = std::upper_bound(thing_ends_.begin(), thing_ends_.end(), triangle);
    return static_cast<std::uint32_t>(end - thing_ends_.begin()) + 1;
}

void TownScene::place_trees(const world::TownT& town) {
    // Prototypes are made when the first of their kind is met.
    std::array<const Prototype*, tree_kinds> trees{};
    std::map<world::PlantKind, const Prototype*> plants;
    const auto first = static_cast<std::uint32_t>(world::TownThings(town).trees);
    for (std::uint32_t i = 0; i < town.trees.size(); ++i) {
        const world::Tree& tree = town.trees[i];
        // Flat ones have no inside that rays could be taken into: Embree would end the process.
        if (!(tree.height() > 0.01) || !(tree.crown_radius() > 0.01))
            continue;
        Instance instance;
        instance.thing = first + i + 1;
        if (tree.kind() == world::PlantKind::any) {
            const Prototype*& prototype = trees[tree.style() % tree_kinds];
            if (prototype == nullptr)
                prototype = add_prototype(tree_mesh(tree.style() % tree_kinds));
            instance.kind = Kind::tree;
            instance.prototype = prototype;
            instance.model = static_cast<std::uint16_t>(tree.style() & 0xffffu);
        } else {
            const Prototype*& prototype = plants[tree.kind()];
            if (prototype == nullptr)
                prototype = add_prototype(plant_mesh(tree.kind()));
            instance.kind = Kind::plant;
            instance.prototype = prototype;
            instance.model = static_cast<std::uint16_t>(tree.kind());
            instance.style = tree.style();
        }
        const double turn = static_cast<double>(tree.style() % 360) * 0.0174533;
        Eigen::Affine3d pose(Eigen::Translation3d(world::to_eigen(tree.position())));
        pose.rotate(Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
        pose.scale(Vector3d(tree.crown_radius(), tree.crown_radius(), tree.height()));
        add_instance(instances_, instance, pose);
    }
}

}  // namespace reprise::render

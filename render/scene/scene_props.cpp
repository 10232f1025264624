#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "render/scene/town_scene.h"
#include "render/shapes/noise.h"
#include "render/shapes/paint.h"
#include "render/shapes/street/prop_mesh.h"
#include "world/check.h"
#include "world/external/instance_id.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

/// Props of one kind share a mesh when they are about of one size; the rest is stretched.
struct SizeClass {
    explicit SizeClass(const PropSize& size)
        : length(size.length > 4 ? steps(size.length, 0.5F) * 5 : steps(size.length, 0.1F)),
          width(steps(size.width, 0.1F)),
          height(steps(size.height, 0.1F)) {}

    static int steps(float value, float step) {
        return std::max(1, static_cast<int>(value / step + 0.5F));
    }

    PropSize size() const {
        return {0.1F * static_cast<float>(length),
                0.1F * static_cast<float>(width),
                0.1F * static_cast<float>(height)};
    }

    auto operator<=>(const SizeClass&) const = default;

    int length;  ///< [dm]
    int width;   ///< [dm]
    int height;  ///< [dm]
};

}  // namespace

void TownScene::place_props(const world::TownT& town) {
    std::map<std::pair<world::PropKind, SizeClass>, const Prototype*> prototypes;
    const auto first = static_cast<std::uint32_t>(world::TownThings(town).props);
    for (std::uint32_t i = 0; i < town.props.size(); ++i) {
        const world::Prop& prop = town.props[i];
        props_.push_back({instances_.size(), Vector3d(1, 1, 1)});
        if (prop.kind() == world::PropKind::parked_vehicle) {
            park(prop, first + i + 1);
            continue;
        }
        const PropSize size = size_of(prop);
        const SizeClass size_class(size);
        const Prototype*& prototype = prototypes[{prop.kind(), size_class}];
        if (prototype == nullptr)
            prototype = add_prototype(prop_mesh(prop.kind(), size_class.size()));
        Instance instance;
        instance.kind = Kind::prop;
        instance.thing = first + i + 1;
        instance.prototype = prototype;
        instance.model = prop.value();
        instance.style = prop.style();
        Eigen::Affine3d pose(world::pose(prop.position(), prop.yaw(), 0));
        const PropSize made = size_class.size();
        props_.back().stretch = {static_cast<double>(size.length / made.length),
                                 static_cast<double>(size.width / made.width),
                                 static_cast<double>(size.height / made.height)};
        pose.scale(props_.back().stretch);
        add_instance(instances_, instance, pose);
    }
}

void TownScene::park(const world::Prop& prop, std::uint32_t thing) {
    REPRISE_CHECK(prop.value() < prototypes_.car_bodies.size(),
                  "parked vehicle of model " + std::to_string(prop.value()));
    const world::VehicleModel& model = *prototypes_.car_shapes[prop.value()].model;
    Instance body;
    body.model = prop.value();
    body.thing = thing;
    body.look = hash(prop.style());
    body.color = paint_of(model, body.look).body;
    // A prop stands on its middle, a car's frame on its rear axle.
    const Eigen::Isometry3d pose =
        world::pose(prop.position(), prop.yaw(), 0) *
        Eigen::Translation3d(model.rear_overhang - model.length / 2, 0, 0);
    const std::size_t first = instances_.size();
    add_car(instances_, pose, body, 0, {}, 0);
    for (std::size_t i = first; i < instances_.size(); ++i)
        if (instances_[i].kind == Kind::car_body)
            instances_[i].kind = Kind::parked;
}

}  // namespace reprise::render

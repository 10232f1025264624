#include "render/shapes/buildings/building_mesh.h"

#include <algorithm>
#include <cmath>

#include "render/shapes/builder.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::FacadeKind;

Eigen::Isometry3f pose_of(const world::Building& building, const Eigen::Vector3d& origin) {
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    const auto yaw = static_cast<float>(building.yaw());
    pose.linear() = Eigen::AngleAxisf(yaw, Vector3f::UnitZ()).toRotationMatrix();
    const Eigen::Vector3d centre(
        building.centre().x(), building.centre().y(), building.centre().z());
    pose.translation() = (centre - origin).cast<float>();
    return pose;
}

/// Half sizes of the footprint.
struct Half {
    float x;
    float y;
};

void add_facade_walls(Builder& build, Half half, float top, Finish wall) {
    const float foot = -0.4F;
    const std::array<Vector3f, 4> plan{
        {{-half.x, -half.y, 0}, {half.x, -half.y, 0}, {half.x, half.y, 0}, {-half.x, half.y, 0}}};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vector3f& from = plan[i];
        const Vector3f& to = plan[(i + 1) % 4];
        build.quad({Vector3f(from.x(), from.y(), foot),
                    Vector3f(to.x(), to.y(), foot),
                    Vector3f(to.x(), to.y(), top),
                    Vector3f(from.x(), from.y(), top)},
                   wall);
    }
}

/// A ledge all around the walls.
void add_ledge(Builder& build, Half half, float out, float low, float high, Finish finish) {
    const Half wide{half.x + out, half.y + out};
    build.box({-wide.x, -wide.y, low}, {wide.x, -half.y + .02F, high}, finish);
    build.box({-wide.x, half.y - .02F, low}, {wide.x, wide.y, high}, finish);
    // Their ends lie in the other two.
    constexpr unsigned ends = box_side::low_y | box_side::high_y;
    build.box({-wide.x, -half.y, low}, {-half.x + .02F, half.y, high}, finish, ends);
    build.box({half.x - .02F, -half.y, low}, {wide.x, half.y, high}, finish, ends);
}

void add_flat_roof(Builder& build, Half half, const Facade& facade, Finish roof) {
    const float deck = facade.eaves - 0.5F;
    build.quad({Vector3f(-half.x, -half.y, deck),
                Vector3f(half.x, -half.y, deck),
                Vector3f(half.x, half.y, deck),
                Vector3f(-half.x, half.y, deck)},
               roof);
    // Parapet with a coping that throws a thin shadow. A little behind the walls: of two faces in
    // one place none would be the nearer one.
    add_ledge(build, {half.x - .25F, half.y - .25F}, 0.24F, deck, facade.eaves, roof);
    add_ledge(
        build, {half.x - .27F, half.y - .27F}, 0.33F, facade.eaves, facade.eaves + .09F, roof);
    const float x = half.x * (unit(hash(facade.seed, 71)) - 0.5F);
    build.box({x - 1.4F, -1.1F, deck}, {x + 1.4F, 1.1F, facade.eaves + 1.7F}, roof);
    build.box({-x - .7F, 1.3F, deck}, {-x + .5F, 2.2F, facade.eaves + .5F}, roof);
}

void add_gabled_roof(
    Builder& build, Half half, const Facade& facade, float ridge, Finish roof, Finish wall) {
    const float out = 0.45F;
    const float slope = (ridge - facade.eaves) / half.y;
    const float low = facade.eaves - out * slope;
    const float thick = 0.16F;
    const Half wide{half.x + 0.3F, half.y + out};
    for (const float side : {-1.0F, 1.0F}) {
        const Vector3f east(side * wide.x, side * wide.y, low);
        const Vector3f west(-side * wide.x, side * wide.y, low);
        const Vector3f ridge_west(-side * wide.x, 0, ridge);
        const Vector3f ridge_east(side * wide.x, 0, ridge);
        const Vector3f up(0, 0, thick);
        // Corners counter-clockwise from above; below side -1 the sun never comes.
        build.quad({west + up, ridge_west + up, ridge_east + up, east + up}, roof);
        build.quad({west, east, ridge_east, ridge_west}, roof);
        build.quad({east, west, west + up, east + up}, roof);
        build.quad({west, ridge_west, ridge_west + up, west + up}, roof);
        build.quad({ridge_east, east, east + up, ridge_east + up}, roof);
        build.triangle({Vector3f(side * half.x, -side * half.y, facade.eaves),
                        Vector3f(side * half.x, side * half.y, facade.eaves),
                        Vector3f(side * half.x, 0, ridge)},
                       wall);
    }
    const float x = half.x * 0.5F;
    build.box({x - .3F, .3F, facade.eaves}, {x + .3F, .9F, ridge + .7F}, wall);
}

/// Slabs with a railing in front of every other bay.
void add_facade_balconies(Builder& build, Half half, const Facade& facade, Finish finish) {
    const int bays = facade.bays(2 * half.x);
    const float bay = 2 * half.x / static_cast<float>(bays);
    for (int floor = 0; floor < facade.floors; ++floor) {
        const float z = facade.ground_floor + facade.floor_height * static_cast<float>(floor);
        for (int i = 1; i + 1 < bays; i += 3) {
            const float x = -half.x + bay * (static_cast<float>(i) + 0.5F);
            const float reach = bay * 0.55F;
            for (const float side : {-1.0F, 1.0F}) {
                const float near = side * half.y;
                const float far = side * (half.y + 1.05F);
                const float rail = side * (half.y + 1.0F);
                build.box({x - reach, std::min(near, far), z - .12F},
                          {x + reach, std::max(near, far), z + .04F},
                          finish);
                build.box({x - reach, std::min(far, rail), z + .1F},
                          {x + reach, std::max(far, rail), z + 1.0F},
                          finish);
            }
        }
    }
}

}  // namespace

Facade::Facade(const world::Building& building) : seed(hash(building.style(), 0x5eedu)) {
    const auto height = static_cast<float>(building.height());
    const std::uint32_t choice = hash(seed, 1) % 8;
    if (height > 17)
        kind = choice < 3 ? FacadeKind::office : choice < 5 ? FacadeKind::glass : FacadeKind::stone;
    else
        kind = choice < 3   ? FacadeKind::brick
               : choice < 6 ? FacadeKind::plaster
                            : FacadeKind::stone;
    const auto width = static_cast<float>(building.width());
    gabled = height < 12.5F && width < 14 && kind != FacadeKind::stone;
    eaves = gabled ? height - std::min(0.33F * width, 0.4F * height) : height;
    ground_floor = gabled ? 3.0F : 3.9F;
    floors = std::max(0, static_cast<int>((eaves - ground_floor - (gabled ? 0.1F : 0.7F)) / 2.95F));
    floor_height =
        floors == 0 ? 3.0F
                    : (eaves - ground_floor - (gabled ? 0.2F : 0.8F)) / static_cast<float>(floors);
}

int Facade::bays(float wall) const {
    const float wish = kind == FacadeKind::glass ? 1.5F : 2.3F + 0.9F * unit(hash(seed, 2));
    return std::max(1, static_cast<int>(wall / wish));
}

void add_building(Mesh& mesh,
                  const world::Building& building,
                  std::uint32_t index,
                  const Eigen::Vector3d& origin) {
    const Facade facade(building);
    const Half half{static_cast<float>(building.length()) * 0.5F,
                    static_cast<float>(building.width()) * 0.5F};
    const Finish wall{Material::facade, index};
    const Finish roof{Material::roof, index};
    Builder build(mesh, pose_of(building, origin));
    add_facade_walls(build, half, facade.eaves, wall);
    if (facade.gabled)
        add_gabled_roof(build, half, facade, static_cast<float>(building.height()), roof, wall);
    else
        add_flat_roof(build, half, facade, roof);
    if (facade.kind != FacadeKind::glass)
        add_ledge(build, half, 0.06F, -0.4F, 0.45F, roof);
    if (facade.kind == FacadeKind::stone || facade.kind == FacadeKind::office)
        add_ledge(build, half, 0.16F, facade.ground_floor - 0.3F, facade.ground_floor - .05F, roof);
    if (facade.kind == FacadeKind::plaster && !facade.gabled)
        add_facade_balconies(build, half, facade, roof);
}

}  // namespace reprise::render

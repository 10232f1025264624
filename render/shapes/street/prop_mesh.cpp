#include "render/shapes/street/prop_mesh.h"

namespace reprise::render {

using world::PropKind;

namespace {

PropSize usual_size(PropKind kind) {
    switch (kind) {
        case PropKind::speed_limit_sign:
        case PropKind::stop_sign:
        case PropKind::yield_sign:
        case PropKind::crossing_sign:
            return {.1F, .66F, 2.5F};
        case PropKind::street_light:
            return {1.8F, .2F, 7.5F};
        case PropKind::pole:
            return {.2F, .2F, 6};
        case PropKind::fence:
            return {5, .08F, 1.1F};
        case PropKind::wall:
            return {5, .3F, 1.4F};
        case PropKind::bench:
            return {1.8F, .6F, .85F};
        case PropKind::bus_stop:
            return {4, 1.5F, 2.5F};
        case PropKind::bin:
            return {.45F, .45F, .95F};
        case PropKind::bollard:
            return {.16F, .16F, .95F};
        case PropKind::hydrant:
            return {.35F, .35F, .75F};
        case PropKind::mailbox:
            return {.5F, .45F, 1.3F};
        case PropKind::hedge:
            return {5, .7F, 1.3F};
        case PropKind::fountain:
            return {5, 5, 2.2F};
        case PropKind::swing:
            return {3.6F, 2, 2.3F};
        case PropKind::table:
            return {1.8F, 1.5F, .75F};
        case PropKind::parked_vehicle:
            return {4.5F, 1.8F, 1.5F};
    }
    return {1, 1, 1};
}

}  // namespace

PropSize size_of(const world::Prop& prop) {
    const PropSize usual = usual_size(prop.kind());
    const auto given = [](double value, float otherwise) {
        return value > 0.01 ? static_cast<float>(value) : otherwise;
    };
    return {given(prop.length(), usual.length),
            given(prop.width(), usual.width),
            given(prop.height(), usual.height)};
}

Mesh prop_mesh(PropKind kind, const PropSize& size) {
    Mesh mesh;
    switch (kind) {
        case PropKind::speed_limit_sign:
        case PropKind::stop_sign:
        case PropKind::yield_sign:
        case PropKind::crossing_sign:
            add_sign(mesh, kind, size);
            break;
        case PropKind::street_light:
            add_street_light(mesh, size);
            break;
        case PropKind::fence:
        case PropKind::wall:
        case PropKind::hedge:
            add_barrier(mesh, kind, size);
            break;
        default:
            add_street_furniture(mesh, kind, size);
    }
    drop_degenerate(mesh);
    return mesh;
}

}  // namespace reprise::render

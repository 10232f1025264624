#include "cli/pictures/annotation.h"

#include <numbers>

#include "render/overlay/overlay.h"
#include "render/overlay/tags.h"
#include "render/trace/camera.h"
#include "world/check.h"
#include "world/models/actors.h"
#include "world/models/viewpoint.h"

namespace reprise::cli {

namespace {

Eigen::Isometry3d pose_of_mount(const world::TickView& tick, const world::SensorSpec& camera) {
    if (camera.actor == 0)
        return Eigen::Isometry3d::Identity();
    const auto pose = world::find_pose(tick, camera.actor);
    REPRISE_CHECK(pose.has_value(), std::to_string(camera.actor));
    return *pose;
}

/// Who carries it and is not in its picture.
std::uint32_t carrier(const world::TickView& tick, const world::SensorSpec& camera) {
    const auto extent = world::find_extent(tick, camera.actor);
    return extent && world::is_carried_at(*extent, camera.position) ? camera.actor : 0;
}

}  // namespace

Annotation::Annotation(const RenderOptions& options, replay::TraceReader& trace)
    : from_above_(options.preset == "top") {
    if (options.overlay)
        story_.emplace(trace);
}

void Annotation::read_to(std::uint64_t tick) {
    if (story_)
        story_->read_to(tick);
}

Annotation::Words Annotation::words(const Subject& subject) const {
    if (!story_)
        return {};
    return {story_->names(), story_->text(subject.tick, subject.actor, subject.last)};
}

void Annotation::write(world::SensorFrame& shown,
                       const world::SensorFrame* depth,
                       const Subject& subject,
                       const Words& words) const {
    if (from_above_) {
        const auto pose = world::find_pose(subject.tick, subject.actor);
        const render::Camera camera(subject.camera, Eigen::Isometry3d::Identity());
        const double above = pose ? subject.camera.position.z() - pose->translation().z() : 0;
        if (above > 0)
            render::write_scale(
                shown, above * camera.pixel(), std::numbers::pi - subject.camera.yaw);
    }
    if (!story_)
        return;
    REPRISE_CHECK(depth != nullptr, shown.name);
    const render::Camera camera(subject.camera, pose_of_mount(subject.tick, subject.camera));
    render::write_overlay(
        shown,
        render::tags_of(
            subject.tick, words.names, camera, *depth, carrier(subject.tick, subject.camera)),
        words.text);
}

}  // namespace reprise::cli

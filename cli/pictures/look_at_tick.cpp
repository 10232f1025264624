#include "cli/pictures/look_at_tick.h"

#include "cli/pictures/box_text.h"
#include "render/picture.h"
#include "world/external/sensor_attributes.h"

namespace reprise::cli {

std::optional<render::Neighbour> neighbour(const Cameras& cameras,
                                           const std::vector<std::size_t>& looking,
                                           const world::SensorRig& rig,
                                           std::uint32_t actor,
                                           const world::TickView& there) {
    if (!cameras.actor(there))
        return std::nullopt;
    render::Neighbour found{there, rig};
    for (std::size_t i = 0; i < looking.size(); ++i) {
        const world::SensorSpec placed = cameras.placed(looking[i], actor, there);
        found.rig[i].actor = placed.actor;
        found.rig[i].position = placed.position;
        found.rig[i].yaw = placed.yaw;
        found.rig[i].pitch = placed.pitch;
    }
    return found;
}

void LookAtTick::point(const Cameras& cameras,
                       const std::vector<std::size_t>& looking,
                       std::uint32_t actor,
                       const world::Weather& weather,
                       bool last) {
    looking_ = looking;
    actor_ = actor;
    last_ = last;
    weather_ = weather;
    for (const std::size_t i : looking)
        rig_.push_back(cameras.placed(i, actor, tick()));
    words_ = annotation_.words({tick(), rig_.front(), actor, last});
    // Cameras of one place look together: what is seen is found once.
    if (annotation_.needs_depth())
        look_also(world::SensorKind::depth);
    first_of_boxes_ = rig_.size();
    if (boxes_) {
        look_also(world::SensorKind::instance);
        look_also(world::SensorKind::semantic);
    }
    if (ticks_.last)
        neighbours_.last = neighbour(cameras, looking_, rig_, actor_, ticks_.last->view());
    if (ticks_.next)
        neighbours_.next = neighbour(cameras, looking_, rig_, actor_, ticks_.next->view());
}

void LookAtTick::seen(std::vector<world::SensorFrame> frames) {
    frames_ = std::move(frames);
    for (std::size_t i = 0; i < looking_.size(); ++i) {
        shown_.push_back(output_.shows(looking_[i]) ? shown(i) : world::SensorFrame());
        if (!output_.in_order()) {
            output_.take(looking_[i], frames_[i], shown_[i]);
            frames_[i] = {};
            shown_[i] = {};
        }
        if (boxes_)
            output_.take_boxes(looking_[i],
                               tick().index(),
                               box_text(tick(),
                                        *boxes_,
                                        rig_[i],
                                        frames_[first_of_boxes_ + i],
                                        frames_[first_of_boxes_ + looking_.size() + i]),
                               frames_[first_of_boxes_ + i]);
    }
}

void LookAtTick::done() {
    for (std::size_t i = 0; i < looking_.size() && output_.in_order(); ++i)
        output_.take(looking_[i], frames_[i], shown_[i]);
}

/// Each camera sees this as well.
void LookAtTick::look_also(world::SensorKind kind) {
    for (std::size_t i = 0; i < looking_.size(); ++i) {
        rig_.push_back(rig_[i]);
        rig_.back().kind = kind;
        // What is of another kind, it would not know.
        std::erase_if(rig_.back().attributes, [&](const world::AttributeValue& one) {
            return world::find_attribute(kind, one.name) == nullptr;
        });
    }
}

world::SensorFrame LookAtTick::shown(std::size_t i) const {
    world::SensorFrame shown = render::viewable(frames_[i]);
    const std::size_t depth = looking_.size() + i;
    annotation_.write(shown,
                      annotation_.needs_depth() ? &frames_[depth] : nullptr,
                      {tick(), rig_[i], actor_, last_},
                      words_);
    return shown;
}

}  // namespace reprise::cli

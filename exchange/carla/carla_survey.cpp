#include "exchange/carla/carla_survey.h"

#include <cmath>
#include <limits>

#include "exchange/carla/carla_models.h"
#include "world/models/catalogue.h"

namespace reprise::exchange {

namespace {

using Eigen::Vector3d;

// [m] A walker's origin is so high above the ground, whatever its figure: CARLA's own stand in
// capsules of one height for all grown ups.
constexpr double half_a_walker = 0.9;
constexpr double half_a_child = 0.6;
constexpr double largest_box = 5000;      // [cm]
constexpr double farthest_trigger = 1e8;  // [cm]
constexpr double height_steps = 32;       // of heights that count as one

class Surveyor {
  public:
    CarlaSurvey found;

    Surveyor() {
        found.low = Vector3d::Constant(std::numeric_limits<double>::max());
        found.high = -found.low;
    }

    void see(const CarlaFrame& frame) {
        if (found.frames++ == 0)
            found.first = frame.elapsed;
        found.last = frame.elapsed;
        for (const CarlaActor& actor : frame.added)
            meet(actor);
        for (const CarlaBox& box : frame.boxes)
            boxes_[box.actor] = box;
        for (const CarlaBox& trigger : frame.triggers) {
            const auto light = found.lights.find(trigger.actor);
            if (light == found.lights.end() ||
                !(trigger.middle.array().abs() < farthest_trigger).all())
                continue;
            light->second = from_carla(trigger.middle);
            found.lights_have_triggers = true;
        }
        for (const CarlaPose& pose : frame.poses)
            if (found.roles.count(pose.actor) > 0)
                take(pose);
    }

    void finish() {
        for (auto& [id, role] : found.roles)
            cast(id, role);
        found.height = found.low.z();
        std::uint64_t below = 0;
        for (const auto& [height, count] : heights_) {
            if (2 * below >= count_)
                break;
            found.height = static_cast<double>(height) / height_steps;
            below += count;
        }
    }

  private:
    /// 0 is nobody in a trace.
    void meet(const CarlaActor& actor) {
        const std::uint32_t id = actor.pose.actor;
        if (actor.kind == CarlaKind::traffic_light)
            found.lights[id] = from_carla(actor.pose.location);
        if (id == 0 || (actor.kind != CarlaKind::vehicle && actor.kind != CarlaKind::walker))
            return;
        found.roles[id].actor = actor;
        if (actor.kind != CarlaKind::vehicle)
            return;
        const auto role = actor.attributes.find("role_name");
        const bool is_hero = role != actor.attributes.end() && role->second == "hero";
        if (!found.hero || (is_hero && !has_hero_))
            found.hero = id;
        has_hero_ = has_hero_ || is_hero;
    }

    void take(const CarlaPose& pose) {
        const bool walks = found.roles.at(pose.actor).actor.kind == CarlaKind::walker;
        const Vector3d at = from_carla(pose.location) - Vector3d(0, 0, walks ? half_a_walker : 0);
        found.low = found.low.cwiseMin(at);
        found.high = found.high.cwiseMax(at);
        if (walks)
            return;  // its origin is only about there
        ++heights_[std::llround(at.z() * height_steps)];
        ++count_;
    }

    /// A car's origin is on the ground below the middle, a walker's in the middle of the body.
    void cast(std::uint32_t id, CarlaRole& role) {
        std::optional<CarlaBox> box;
        const auto recorded = boxes_.find(id);
        // What is no number is not less than anything.
        if (recorded != boxes_.end() &&
            (recorded->second.middle.array().abs() < largest_box).all() &&
            (recorded->second.extent.array() > 0).all() &&
            (recorded->second.extent.array() < largest_box).all())
            box = recorded->second;
        if (role.actor.kind == CarlaKind::walker) {
            const CarlaModel model = walker_model_for(role.actor);
            role.model = model.model;
            role.guessed_by = model.guessed_by;
            role.above = box ? box->extent.z() / 100 - box->middle.z() / 100
                             : (world::walker_models()[model.model].age == world::Age::child
                                    ? half_a_child
                                    : half_a_walker);
            return;
        }
        const CarlaModel model = vehicle_model_for(role.actor, box);
        role.model = model.model;
        role.guessed_by = model.guessed_by;
        const world::VehicleModel& ours = world::vehicle_models()[model.model];
        role.ahead = (box && std::abs(box->middle.x()) < 500 ? box->middle.x() / 100 : 0) -
                     (ours.length / 2 - ours.rear_overhang);
    }

    std::map<std::uint32_t, CarlaBox> boxes_;
    bool has_hero_ = false;
    std::map<std::int64_t, std::uint64_t> heights_;  ///< how often each was driven at
    std::uint64_t count_ = 0;
};

}  // namespace

Vector3d from_carla(const Vector3d& location_cm) {
    return {location_cm.x() / 100, -location_cm.y() / 100, location_cm.z() / 100};
}

CarlaSurvey survey(CarlaLog& log, const std::function<void(std::uint64_t)>& progress) {
    Surveyor surveyor;
    while (const CarlaFrame* frame = log.next()) {
        surveyor.see(*frame);
        progress(log.offset());
    }
    surveyor.finish();
    return std::move(surveyor.found);
}

}  // namespace reprise::exchange

#include "walkers/person.h"

#include "world/models/carried.h"
#include "world/models/catalogue.h"
#include "world/random.h"
#include "world/tick.h"

namespace reprise::walkers {

namespace {

constexpr double phone_pace =
    0.8;  ///< of the own speed: Lamberg and Muratori, Gait Posture 35, 2012: less by up to a third
constexpr double runners = 0.04;  ///< share of those who could
constexpr double pairs = 0.15;    ///< share who bring somebody

/// Who crosses anywhere does it where it saves a few metres; a metre on the road is not quite as
/// good as one beside it.
constexpr double least_road_cost = 1.2;
constexpr double more_road_cost = 0.8;

enum Question : std::uint64_t {
    which_model,
    pace,
    run,
    which_side,
    jaywalk,
    with_friend,
    road_cost
};

}  // namespace

Person draw_person(std::uint64_t seed, std::uint32_t id, double jaywalkers) {
    const auto drawn = [&](Question question) {
        return world::draw(seed, question, world::Purpose::walker, id);
    };
    const auto models = world::walker_models();
    Person person;
    person.model =
        static_cast<std::uint16_t>(drawn(which_model) * static_cast<double>(models.size()));
    const world::WalkerModel& model = models[person.model];
    person.look = world::drawn_look(seed, id).look();
    const bool on_phone = world::carried_by(model, person.look).phone;
    const bool fit = (model.age == world::Age::adult || model.age == world::Age::teen) && !on_phone;
    person.speed = model.walking_speed * (0.85 + 0.3 * drawn(pace));
    if (fit && drawn(run) < runners)
        person.speed = 2.5 + drawn(pace);
    if (on_phone)
        person.speed *= phone_pace;
    person.radius = model.shoulder_width / 2;
    person.side = 0.7 * drawn(which_side);
    person.jaywalks = drawn(jaywalk) < jaywalkers;
    person.road_cost = least_road_cost + more_road_cost * drawn(road_cost);
    person.brings_friend = drawn(with_friend) < pairs;
    return person;
}

}  // namespace reprise::walkers

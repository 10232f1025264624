#pragma once

#include <cstdint>

namespace reprise::walkers {

/// Who somebody is: drawn once, from the seed and the id alone.
struct Person {
    std::uint16_t model = 0;  ///< index in world::walker_models(), which says the height
    double speed = 0;         ///< [m/s] at ease: the model's, 15 % more or less; runners 2.5 to 3.5
    double radius = 0;        ///< [m] of the body, from above
    double side = 0;          ///< [m] how far to the right of the straightest way
    std::uint32_t look = 0;   ///< outfit, and what is carried
    bool jaywalks = false;    ///< crosses the road anywhere
    double road_cost = 0;     ///< of who does: [m] of sidewalk that a metre of road is worth
    bool brings_friend = false;  ///< the next one walks beside
};

/// `jaywalkers`: share of those who cross anywhere.
Person draw_person(std::uint64_t seed, std::uint32_t id, double jaywalkers);

}  // namespace reprise::walkers

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "traffic/cars/car.h"
#include "world/digest.h"
#include "world/tick.h"

namespace reprise::traffic {

/// The cars that traffic owns, sorted by id.
class Cars {
  public:
    std::span<Car> all() { return cars_; }

    std::span<const Car> all() const { return cars_; }

    std::size_t size() const { return cars_.size(); }

    Car& operator[](std::size_t index) { return cars_[index]; }

    /// Null when there is none of this id. Valid until the next add or remove, as all references.
    Car* find(std::uint32_t id);
    const Car* find(std::uint32_t id) const;

    /// With a spawned event of this text, which names the script's line; 0: no script.
    Car& add(Car car, const std::string& text, std::uint32_t line, world::TickDraft& next);

    /// With a despawned event.
    void remove(std::size_t index, world::TickDraft& next);

    /// As `remove`, and out of SUMO, where SUMO has it.
    void remove_from_sumo(std::size_t index, world::TickDraft& next);

    /// As `remove_from_sumo`, without an event: from now on it is somebody else's.
    void hand_over(std::size_t index);

    /// All that decides what the cars do next: their motion, trails, routes and orders.
    void add_to(world::Hasher& hasher) const;

    /// What SUMO's step makes of them: their motion, unrounded. 10 ns a car.
    void add_motions_to(world::Hasher& hasher) const;

  private:
    std::vector<Car> cars_;
};

}  // namespace reprise::traffic

#pragma once

#include <string>

namespace reprise::traffic {

/// While this lives, SUMO does not look for the vehicle of this name when this thread asks: each
/// getter finds it in a tree of all names, which costs as much as ten of them need for the answer.
/// It is looked up once in the vehicle's life, and kept with the car. No step may be made
/// meanwhile.
class KnownVehicle {
  public:
    /// Both must outlive this. `vehicle` is SUMO's; null until the first look.
    KnownVehicle(const std::string& name, void*& vehicle);
    ~KnownVehicle();
    KnownVehicle(const KnownVehicle&) = delete;
    KnownVehicle& operator=(const KnownVehicle&) = delete;
};

}  // namespace reprise::traffic

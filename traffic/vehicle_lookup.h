#pragma once

namespace reprise::traffic {

/// While one of these lives, SUMO does not look again for the vehicle that it was asked about last:
/// each getter finds it by its name, in a tree of all names, which costs as much as ten of them
/// need for the answer. No vehicle may be added or removed meanwhile, nor a step be made.
class OneLookup {
  public:
    OneLookup();
    ~OneLookup();
    OneLookup(const OneLookup&) = delete;
    OneLookup& operator=(const OneLookup&) = delete;
};

}  // namespace reprise::traffic

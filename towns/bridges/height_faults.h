#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "towns/check/criterion.h"
#include "towns/town_reader.h"

namespace reprise::towns {

/// A place where the heights of bridges, tunnels and ramps break a promise of the town.
struct HeightFault {
    enum class Kind : std::uint8_t {
        steep,  ///< a ramp of more than 15 %
        low,    ///< another road 0.5 m to 4.8 m above, which leaves 4 m under its deck at most
        ground  ///< no ground that can be driven or walked on, as `town check` measures it
    };

    Kind kind = Kind::ground;
    Eigen::Vector2d place;  ///< world
};

/// Finds out whether a town that was good when it was flat still is with heights.
class HeightFaultFinder {
  public:
    /// The town before it got heights.
    explicit HeightFaultFinder(Network flat) : flat_(std::move(flat)) {}

    /// What is wrong with the same town, its network being `xml` now; the worst places of each kind
    /// only. Empty: nothing that was not wrong already. Costs half a `town check`, and little
    /// where ramps are too steep.
    std::vector<HeightFault> faults(const std::string& xml);

  private:
    bool was_there(const towns::Criterion& criterion, const towns::Criterion::Place& place);

    Network flat_;
    std::optional<std::vector<towns::Criterion>> criteria_of_flat_;
};

}  // namespace reprise::towns

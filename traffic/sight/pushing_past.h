#pragma once

#include <cstdint>

#include "traffic/cars/cars.h"
#include "traffic/roads/lane_lines.h"
#include "traffic/sight/foresight.h"
#include "traffic/sight/met_driver.h"

namespace reprise::traffic {

/// Two who stand, each for the other's body, block each other for good: one pushes past.
///
/// MUST    not drive through the other one, nor stay beside his lane when he is through.
/// ASSUMES that the other one stands still meanwhile, for which Meetings sees.
/// GOES    by the one who is less deep in the other one's body on his way; not where that is deeper
///         than mirrors give way. He steers aside, out of that body, as far as his lanes are wide.
/// KEEPS   with each car, whom it pushes past until when, and that it leans.
class PushingPast {
  public:
    static constexpr double deepest =
        0.20;  ///< [m] in another one's body, which mirrors give way to

    /// Must outlive this.
    explicit PushingPast(const LaneLines& lines) : lines_(&lines) {}

    /// One of the two begins to, or goes on, if any can.
    void begin(MetDriver& one, MetDriver& other, std::uint64_t tick) const;

    /// Does it push past that other one?
    static bool has_begun(const MetDriver& driver, const MetDriver& other, std::uint64_t tick);

    /// Behind all meetings of the tick: the car steers aside, or comes back.
    static void steer(Car& car, const MetDriver& driver, std::uint64_t tick);

  private:
    double lean_for(const MetDriver& driver, const Foresight::Intrusion& intrusion) const;

    const LaneLines* lines_;
};

}  // namespace reprise::traffic

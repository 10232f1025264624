#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "traffic/sight/way_ahead.h"

namespace reprise::traffic {

/// What one driver will cover in the next seconds. Each body is worked out when somebody asks for
/// it: of most none is needed, because the others are far.
class Foresight {
  public:
    static constexpr std::size_t samples = 21;  ///< of the time that is looked at, from now on
    static constexpr double sample = 0.13;      ///< [s] between two of them
    static constexpr double look_ahead = 2.6;   ///< [s] all of it
    static constexpr double spacing = 0.4;      ///< [m] of the steps
    static constexpr double room = 0.1;         ///< [m] at each side of one who passes
    static constexpr double least_speed = 1.5;  ///< [m/s] that who waits will have in a moment
    static constexpr double speeding_up = 2.0;  ///< [m/s] that who brakes would have without

    /// Who lies nowhere within `reach` [m] of way ahead is not met. Of a car that outlives the
    /// questions.
    void look(const Car& car, const LaneLines& lines, const RoadGraph& graph, double reach);

    /// The same car, which is as it was; it may lie elsewhere in memory by now.
    void stay(const Car& car) { way_.stay(car); }

    const WayAhead& way() const { return way_; }

    const BodyBox& now() const { return now_; }

    /// Around all that it will cover, with room beside.
    const BodyBox& corridor();

    /// False: they touch neither now nor at any moment that is looked at. Quick.
    bool may_touch(const Foresight& other) const { return moments_near(other) != 0; }

    /// The first of the bodies along its way, as first_on_way_of compares them.
    const BodyBox& way_start() { return sweep().front(); }

    /// Would it come into the other one, as that drives on, at about the speed that it has or will
    /// have in a moment?
    bool would_meet(Foresight& other);

    /// Likewise, into what stands there.
    bool would_meet(const BodyBox& standing);

    /// How deep in another body, and on which side of its own that one is there.
    struct Intrusion {
        double depth = 0;      ///< [m]; 0: beside it
        bool is_left = false;  ///< of the body's middle
        bool is_behind = false;
    };

    /// Where its body would lie in that one deepest, within `reach` [m] of way.
    Intrusion deepest_in(const BodyBox& standing, double reach) const;

    /// [m] that it would lie in that one there.
    double depth_in(const BodyBox& standing, double reach) const {
        return deepest_in(standing, reach).depth;
    }

    /// Where its body would lie first, driving on, on what another one stands on, or drives over.
    struct Entry {
        double driven = 0;      ///< [m]
        BodyBox body;           ///< of its own
        bool is_first = false;  ///< on the first of the bodies asked for
        bool is_any = false;
    };

    Entry first_on(const BodyBox& standing);
    Entry first_on_way_of(Foresight& other);

  private:
    static constexpr std::size_t stretches = 5;  ///< of time, each with as many of the samples

    /// Bodies at the same distances from each other; worked out at most once.
    struct Row {
        std::array<BodyBox, samples> bodies;
        std::uint32_t known = 0;  ///< a bit each
    };

    const BodyBox& drives(std::size_t i);
    const BodyBox& soon(std::size_t which, std::size_t i);
    double tried_speed(std::size_t which) const;
    std::uint32_t moments_near(const Foresight& other) const;
    std::span<const BodyBox> sweep();
    Entry first_on(std::span<const BodyBox> others, double radius);

    WayAhead way_;
    BodyBox now_;
    BodyBox corridor_;
    bool has_corridor_ = false;
    std::array<WayAhead::Stretch, stretches> stretches_;
    double speed_ = 0;
    double reach_ = 0;
    double radius_ = 0;        ///< [m] from the middle of its body to a corner,
    double roomy_radius_ = 0;  ///< [m] and with room beside
    double most_moved_ = 0;    ///< [m] of its middle, for each metre driven
    Row drives_;               ///< as it drives on now, by time
    std::array<Row, 2> soon_;  ///< at about the speeds that it will have, by time; with room beside
    Row sweep_;                ///< all that it will drive over, by way
};

}  // namespace reprise::traffic

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::traffic {

/// SUMO's cars among each other where ways cross, join and bend. SUMO knows who has to wait, and
/// lines with a width; not that a body turns: that its corner reaches out, its tail cuts in.
///
/// MUST    let no body come into another's while one of the two can still stop before it.
/// ASSUMES that each follows the lanes of its route, and goes on at about its speed.
/// GOES    by the bodies of the next seconds, of each two that could meet and of which neither
///         follows the other. Of two who would meet one waits before the other's way: who must by
///         the rules, else who comes there later; the other one, where he can no longer. Who has
///         begun to wait keeps to it. When both have stood for long the other one tries, and where
///         they block each other for good, one pushes past.
/// KEEPS   with each car, whom it waits for, and until when it pushes past others.
class Meetings {
  public:
    /// Both must outlive this. `step` [s] of a tick.
    Meetings(const world::TownT& town, const RoadGraph& graph, double step);

    /// As the cars are now, in the tick being made.
    void look(Cars& cars, std::uint64_t tick);

    /// [m/s] for cars[index] in the next tick, as of the last look; infinite where nobody is met.
    double allowed_speed(std::size_t index) const { return allowed_[index]; }

  private:
    static constexpr std::size_t samples = 21;  ///< of the time that is looked at, from now on

    using Bodies = std::array<BodyBox, samples>;

    /// Bodies, and the box around all of them: most pairs are told apart by that.
    struct Swath {
        std::vector<BodyBox> bodies;
        world::Box around;

        void clear();
        void add(const BodyBox& body);
    };

    /// What a driver will cover in the next seconds. Made where somebody is near, each part once.
    struct Foresight {
        std::optional<WayAhead> way;
        world::Box area;  ///< that it does not leave
        BodyBox now;
        bool has_bodies = false;
        Bodies bodies;      ///< as it drives on now, by time
        world::Box around;  ///< of these
        Swath soon;         ///< at about the speeds that it will have: by speed, then by time
        Swath sweep;        ///< all that it will drive over, by way
        Swath steps;        ///< likewise, closer to each other, with room beside
    };

    /// One of the cars.
    struct Driver {
        Car* car = nullptr;
        std::size_t index = 0;
        Eigen::Vector2d middle;
        double half_length = 0;
        double reach = 0;           ///< [m] of way that is looked at
        Foresight* seen = nullptr;  ///< once it is asked for
        bool yields = false;
        bool is_turning = false;               ///< or will be in a moment
        std::vector<std::uint32_t> waits_for;  ///< ids, of this tick
    };

    /// Where one can stop before another's way.
    struct Stop {
        double distance = 0;  ///< [m] that its bumper may go on
        double speed = 0;     ///< [m/s] of what is there, along its way
        bool is_possible = false;
        double time = 0;  ///< [s] until it is there
    };

    void gather(Cars& cars);
    bool could_meet(const Driver& one, const Driver& other) const;
    void meet(Driver& one, Driver& other);
    void follow(const Driver& one, const Driver& other);
    void wait(Driver& driver, Driver& other, const Stop& stop);
    void prepare(Driver& driver);
    bool has_stood(const Driver& driver) const;
    bool first_waits(const Driver& one,
                     const Driver& other,
                     const Stop& stop_one,
                     const Stop& stop_other) const;
    static bool follows(const Driver& driver, const Driver& leader);
    static bool is_all_on_its_lane(const Driver& driver);
    static const Foresight& with_bodies(const Driver& driver);
    static const Swath& soon(const Driver& driver);
    static const Swath& sweep(const Driver& driver);
    static const Swath& steps(const Driver& driver);
    static bool would_meet(const Driver& driver, const Foresight& other);
    static bool would_meet(const Driver& driver, const BodyBox& standing);
    Stop stop_before(const Driver& driver, const Driver& other, std::span<const BodyBox> way) const;
    void hold(const Driver& driver, const Stop& stop);

    const world::TownT* town_;
    const RoadGraph* graph_;
    double step_;               ///< [s]
    std::vector<bool> yields_;  ///< by lane of a junction: has to let others go first
    std::vector<double> allowed_;
    std::vector<Driver> drivers_;
    std::vector<std::unique_ptr<Foresight>> foresights_;  ///< of drivers, kept for their memory
    std::size_t foreseen_ = 0;                            ///< that are in use in this tick
    std::uint64_t tick_ = 0;
};

}  // namespace reprise::traffic

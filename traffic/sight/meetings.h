#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/lane_lines.h"
#include "traffic/roads/right_of_way.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/foresight.h"
#include "traffic/sight/meeting_places.h"
#include "traffic/sight/met_driver.h"
#include "traffic/sight/pushing_past.h"
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
///         begun to wait keeps to it. Before a long one that lies over his way in a bend who comes
///         towards it waits where he leaves it its own. When both have stood for long the other one
///         tries, and where they block each other for good, one pushes past, for which the other
///         one stands still, aside from it in its own lane; not where it would be through the
///         other one. Who lies in another one
///         gets no deeper in.
/// KEEPS   with each car, whom it waits for, and whom it pushes past until when (PushingPast); who
///         is held back before what, from one look to the next.
class Meetings {
  public:
    /// All three must outlive this. `step` [s] of a tick.
    Meetings(const world::TownT& town,
             const RoadGraph& graph,
             const RightOfWay& right_of_way,
             double step);

    /// As the cars are now, in the tick being made; for keep() in the next ones. Another thread may
    /// do it while nobody else changes or asks anything of the cars or of this.
    void look(Cars& cars, std::uint64_t tick);

    /// Every second tick is enough for who looks seconds ahead.
    static bool looks_in(std::uint64_t tick) { return tick % 2 == 0; }

    /// Whoever is held back since the last look goes on with it, one tick later and further on.
    void keep(const Cars& cars);

    /// What look() will find in that tick, if nothing happens to the cars until then; where
    /// something does, it looks anew. Changes nothing that can be asked here: another thread may do
    /// it while nobody else changes or asks anything of the cars or of this.
    void look_ahead(std::span<const Car> cars, std::uint64_t tick);

    /// [m/s] for cars[index] in the next tick, as of the last look or keep; infinite where nobody
    /// is met.
    double allowed_speed(std::size_t index) const { return allowed_[index]; }

    /// Of the town's lanes, for who foretells bodies as well.
    const LaneLines& lines() const { return lines_; }

    /// What is kept beside what the cars keep.
    void add_to(world::Hasher& hasher) const;

  private:
    using Driver = MetDriver;

    /// Whom it holds back, and before what.
    struct Hold {
        std::uint32_t id = 0;
        std::uint32_t index = 0;  ///< that it had when it was seen
        double distance = 0;      ///< [m] that its bumper may go on
        double speed = 0;         ///< [m/s] of what is there, along its way
    };

    /// Where one can stop before another's way.
    struct Stop {
        double distance = 0;  ///< [m] that its bumper may go on
        double speed = 0;     ///< [m/s] of what is there, along its way
        bool is_possible = false;
        double time = 0;  ///< [s] until it is there
    };

    bool has_foreseen(std::span<const Car> cars, std::uint64_t tick) const;
    void gather(std::span<const Car> cars);
    void look_at_pairs();
    bool could_meet(const Driver& one, const Driver& other) const;
    void meet(Driver& one, Driver& other);
    void follow(const Driver& one, const Driver& other);
    void keep_behind(const Driver& driver, const Driver& leader);
    void wait(Driver& driver, Driver& other, const Stop& stop);
    void prepare(Driver& driver);
    void part(const Driver& one, const Driver& other);
    void let_past(const Driver& driver, const Driver& other);
    bool has_stood(const Driver& driver) const;
    bool is_stuck(const Driver& driver) const;
    std::uint32_t in_junction(const Driver& driver) const;
    bool leaves_junction(const Driver& driver) const;
    bool lets_out(const Driver& driver, const Driver& other) const;
    bool first_waits(const Driver& one, const Driver& other) const;
    bool lies_in_way_of(const Driver& driver, const Driver& comer) const;
    static bool follows(const Driver& driver, const Driver& leader);
    static bool comes_back(const Driver& one, const Driver& other);
    static bool is_all_on_its_lane(const Driver& driver);
    static Stop stop_at(const Driver& driver,
                        const Foresight::Entry& entry,
                        const Driver& other,
                        const BodyBox& first);
    static Stop stop_before_way(const Driver& driver, const Driver& other);
    static Stop stop_before_body(const Driver& driver, const Driver& other);
    void hold(const Driver& driver, const Stop& stop);
    double speed_before(const Car& car, const Hold& hold) const;

    const LaneLines lines_;
    const RoadGraph* graph_;
    MeetingPlaces places_;
    PushingPast pushing_past_;
    const RightOfWay* right_of_way_;
    double step_;               ///< [s]
    std::vector<bool> yields_;  ///< by lane of a junction: has to let others go first
    std::vector<double> allowed_;
    std::vector<Hold> found_;      ///< by looking, also ahead
    std::vector<Hold> kept_;       ///< of the last look, as of the last tick
    std::vector<Driver> drivers_;  ///< [i] of cars[i]; without a car who takes no part
    std::uint64_t tick_ = 0;
    std::uint64_t ahead_of_ = 0;  ///< tick that was looked at ahead; 0: none
};

}  // namespace reprise::traffic

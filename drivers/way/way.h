#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/way/conflicts.h"
#include "drivers/way/itinerary.h"
#include "drivers/way/lane_graph.h"
#include "drivers/way/path.h"
#include "world/digest.h"

namespace reprise::drivers {

/// A lane under the path, from `start` to `end` along the path.
struct PathPiece {
    std::uint32_t lane = 0;
    double start = 0;
    double end = 0;
};

/// The end of a lane where the path enters a junction.
struct Gate {
    double s = 0;       ///< of the lane's end, along the path
    double exit_s = 0;  ///< where the path leaves the junction
    std::uint32_t serial = 0;
    std::uint32_t signal = 0;
    std::uint32_t from = 0;
    std::uint32_t link = 0;  ///< index in the links of `from`
    std::uint32_t to = 0;
    world::Turn turn = world::Turn::straight;
    bool yields = false;
    bool crossed = true;         ///< by others' ways, or by people on foot
    bool has_stop_sign = false;  ///< and gives way: a main road's crossing may be signed as well
    std::vector<ConflictPoint> conflicts;
};

/// A change of lanes along the path.
struct LaneChange {
    double start = 0;
    double end = 0;
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    double spare = 0;  ///< [m] that it could begin later
    bool to_left = false;
};

/// Where a way starts anew, and what the car can do there.
struct WayStart {
    double s = 0;            ///< [m] on the first lane: where the path starts
    double car_s = 0;        ///< [m] on the first lane: where the car is, at or ahead of s
    double speed = 0;        ///< [m/s] of the car
    double change_room = 0;  ///< [m] ahead of the car where no change of lanes can start
};

/// The driver's way ahead: lanes, one after another, with their geometry as one Path and the places
/// where something must be decided. Grows at the far end, drops what lies behind. Leads through the
/// stops that it was given; where a change of lanes on the way there has no room it goes on as its
/// lane does and plans anew.
class Way {
  public:
    Way(const LaneGraph& graph, std::uint64_t seed, std::uint32_t actor);

    /// Starts anew on the first of `lanes`; the others are the next ones to come. Stops that the
    /// car has not passed yet stay.
    void restart(const std::vector<std::uint32_t>& lanes, const WayStart& start);

    /// Lanes to pass in this order, the last one at `last_s` [m]: where to go when the lanes of the
    /// next restart end.
    void set_stops(std::vector<std::uint32_t> stops, double last_s);

    /// Never changes lanes from now on but where a restart says so; goes on as its lane does, and
    /// ends where that ends. Or again as it likes.
    void keep_lane(bool keep) { itinerary_.keep_lane(keep); }

    bool keeps_lane() const { return itinerary_.keeps_lane(); }

    /// Not passed yet.
    std::span<const std::uint32_t> stops() const { return itinerary_.stops(); }

    /// [m] of the last stop.
    double last_s() const { return itinerary_.last_s(); }

    /// Makes at least `ahead` metres of path beyond s, unless the way ends.
    void extend(double s, double ahead);

    /// Forgets lanes that end before s, and in steps of some metres the path more than `kept`
    /// metres before it.
    void drop_before(double s, double kept);

    const Path& path() const { return path_; }

    const std::vector<Gate>& gates() const { return gates_; }

    const std::vector<LaneChange>& changes() const { return changes_; }

    /// Lanes of the pieces, from the one at the s of the last drop_before.
    const std::vector<std::uint32_t>& lanes() const { return lanes_; }

    const std::vector<PathPiece>& pieces() const { return pieces_; }

    /// The lanes from the one at s on, as far as they are decided; of internal lanes only the
    /// first.
    std::vector<std::uint32_t> lanes_to_come(double s) const;

    /// Does the way end where the path ends (a dead end), or will it go on?
    bool ended() const { return ended_; }

    /// Changes whenever path, gates or changes do.
    std::uint64_t plan_digest() const { return plan_digest_; }

    void add_to(world::Hasher& hasher) const;

  private:
    /// For one of the changes of lanes that are due on next_lane_.
    struct ChangeRoom {
        double wait = 0;    ///< [m] ahead of it
        double length = 0;  ///< [m]
        double spare = 0;   ///< [m] that it could begin later
    };

    void name_lanes();
    void note_plan();
    void append_next_lane();
    void append_inside();
    bool follow_itinerary();
    void wander();
    std::optional<ChangeRoom> room_for_change(const Itinerary::Changes& changes,
                                              double earliest = 0) const;
    double share_of_room(double from, const Itinerary::Changes& changes) const;
    void append_straight(std::uint32_t lane, double from);
    void append_change(std::uint32_t to, const ChangeRoom& room);
    void append_junction(std::uint32_t lane, std::uint32_t link);
    void append_piece(std::uint32_t lane, const std::vector<Eigen::Vector3d>& line, double limit);

    const LaneGraph* graph_;
    Itinerary itinerary_;
    std::uint64_t seed_;
    std::uint32_t actor_;
    Path path_;
    std::vector<PathPiece> pieces_;
    std::vector<std::uint32_t> lanes_;
    std::vector<Gate> gates_;
    std::vector<LaneChange> changes_;
    std::uint32_t next_lane_ = world::none;  ///< to be appended from next_s_ on
    double next_s_ = 0;
    double car_ahead_ = 0;     ///< [m] from next_s_ to the car, on the lane where the way starts
    double car_path_s_ = 0;    ///< where the car was at the restart, along the path
    double car_speed_ = 0;     ///< [m/s] then
    double changes_from_ = 0;  ///< along the path; none starts before
    std::uint32_t junctions_ = 0;  ///< gates made so far: the draws' tick
    bool ended_ = false;
    std::uint64_t plan_digest_ = 0;  ///< of path, gates and changes, as of their last change
};

}  // namespace reprise::drivers

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "towns/check/furniture_check.h"
#include "towns/furnish/clearance.h"
#include "towns/furnish/give_way.h"
#include "towns/furnish/ground_heights.h"
#include "towns/furnish/roadside.h"
#include "towns/network/place.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// What every furnishing step (heads, signs, buildings, plants, ...) reads and writes: the town so
/// far, and the space that is taken already.
struct PlacementContext {
    PlacementContext(world::TownT& target,
                     const Place& source,
                     const std::vector<GiveWay>& signed_lanes);

    world::TownT& town;
    const Place& place;
    const std::vector<GiveWay>& right_of_way;  ///< one for each lane
    std::uint64_t seed;                        ///< of the town's name
    std::vector<Roadside> roadsides;
    GroundHeights ground_heights;

    // Obstacles by kind. [m] The largest distance that a step asks for.
    Clearance roads{20};     ///< lanes for vehicles, and where buses sweep over more than those
    Clearance junctions{4};  ///< their outlines, walking areas included
    Clearance walks{8};      ///< sidewalks, with round ends, and walking areas
    Clearance paved{0.1};    ///< the same, with the ends that they have
    Clearance walkways{1};   ///< the middle of sidewalks and crossings, which nothing may narrow
    Clearance crossings{4};
    Clearance reserved{8};    ///< plots, and what must be kept clear of buildings and plants
    Clearance solid{8};       ///< what stands: buildings, furniture, trunks, parked cars
    Clearance buildings{20};  ///< again, for crowns
    Clearance sights{12};     ///< corners of unlit junctions that drivers look across

    /// Do roads within some 30 m lie at different heights? Nothing stands there, because the land
    /// beside the road is then not as high as the road.
    bool is_steep(const Eigen::Vector2d& p) const;

    /// Is there no road within some 80 m?
    bool is_outside(const Eigen::Vector2d& p) const;

    /// Is the road outside of built-up streets? Fast roads, and one-way roads without a sidewalk
    /// (ramps, carriageways of a motorway).
    bool is_rural(const Roadside& roadside) const;

    /// Height of the ground beside or under the side of a road that is at this height: sidewalks
    /// are raised. [m]
    double ground(const Eigen::Vector2d& p, double road_z) const;

    /// How far ground() is below where it would be beside a level road: what poles carry must hang
    /// that much higher over their feet. Negative: above. [m]
    double drop(const Eigen::Vector2d& p, double road_z) const;

    /// May a pole with a foot this wide stand there? Off the road by `margin`, off crossings, on a
    /// sidewalk or beside the road.
    bool may_stand(const Eigen::Vector2d& p, double margin) const;

    /// Does a pole there leave walkers a way past it: off the sidewalks, or at their kerb or outer
    /// edge?
    bool leaves_walkway_free(const Eigen::Vector2d& p) const;

    /// The place nearest to `wish` where a pole may stand, on ground about as high as its road, and
    /// leaves walkers their way; else where it may stand at all. At most `reach` away. [m]
    std::optional<Eigen::Vector2d> pole_place(const Eigen::Vector2d& wish,
                                              double reach,
                                              double road_z) const;

  private:
    struct Levels {
        double low;
        double high;
    };

    void add_lanes();
    void add_walking_area(const world::LaneT& lane);
    void add_sidewalk(const world::LaneT& lane);
    void add_swept_area();
    void add_level(const world::LaneT& lane);
    void add_sights();

    /// Of the ground where roads lie level.
    double level_ground(const Eigen::Vector2d& p, double road_z) const;

    std::map<std::pair<std::int32_t, std::int32_t>, Levels> levels_;
};

/// Nothing but signs, poles and bollards is nearer to a kerb's face. [m]
inline constexpr double kerb_margin = 0.5;

/// Signs, lamps, bollards and other poles stand this far from the kerb. [m]
inline constexpr double pole_margin = 0.3;

/// Beside the middle of a sidewalk nothing stands: a little more than what is checked. [m]
inline constexpr double walkway_half_width = towns::walker_clearance + 0.02;

/// What walkers need to pass by. [m]
inline constexpr double walking_width = 1.2;

/// Nothing higher than 1 m stands nearer to the kerbs of an unlit junction, poles excepted. [m]
inline constexpr double sight_distance = 8;

}  // namespace reprise::towns

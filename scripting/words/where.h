#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scripting/lua/arguments.h"
#include "scripting/run/run.h"

namespace reprise::scripting {

/// Where somebody is put: on a lane, or at a pose. Of its reference point.
struct Place {
    std::uint32_t lane = world::none;  ///< none: at a pose
    double s = 0;
    double offset = 0;
    Eigen::Vector3d p_world{0, 0, 0};
    double yaw = 0;

    /// Into a spawn or a teleport.
    void say(world::CommandT& command) const;
};

/// Does it say one by another actor? Then that handle is put onto the stack: whoever reads the
/// place waits for it first (all_present) where it has none yet.
bool push_related(const Fields& fields);

/// The place that the keys say, fit for this actor, or refuses; none where they say none.
std::optional<Place> read_place(Run& run, lua_State* L, const Fields& fields, const Actor& actor);

/// Does it move by itself, along lanes? Not walkers, props and who is parked.
bool drives(const Actor& actor);

/// What the actor will cover there.
Footprint footprint_at(const Actor& actor, const Place& place);

/// Refuses, naming both, where another one is.
void want_free_place(Run& run, lua_State* L, const std::string& who, const Actor& actor);

/// Of the road there: of the nearest to `near` where there are several levels, of the upper one
/// without; off every road that of the nearest. None farther than 1 km from any. [m]
std::optional<double> road_height(
    Run& run, lua_State* L, double x, double y, std::optional<double> near);

}  // namespace reprise::scripting

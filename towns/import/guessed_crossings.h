#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "world/town_generated.h"

namespace reprise::towns {

/// netconvert guesses crossings wherever sidewalks meet a junction: at real ones, and also where
/// one road goes on as another, such as at a change of its limit.
struct GuessedCrossings {
    int at_joins = 0;  ///< crossings where at most two roads meet, and no light and no crossing is
    std::string connections;  ///< for --connection-files: not to be guessed again
};

/// `mapped` are the crossings of the map in the network's coordinates: what is within 15 m of one
/// stays. `network` is what netconvert wrote.
GuessedCrossings guessed_crossings(const std::string& network,
                                   const std::vector<Eigen::Vector3d>& mapped);

/// The middle of each crossing that a town has.
std::vector<Eigen::Vector3d> places_of_crossings(const world::TownT& town);

/// How many of the map's crossings, of those that lie on a road for cars, have none of the town
/// within 15 m.
int lost_crossings(const world::TownT& town, const std::vector<Eigen::Vector3d>& mapped);

}  // namespace reprise::towns

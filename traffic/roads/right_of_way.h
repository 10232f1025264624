#pragma once

#include <cstdint>
#include <vector>

#include "world/town.h"

namespace reprise::traffic {

/// Who lets whom go first in a junction, as SUMO has it: a way that turns left lets who comes
/// towards it, a minor road the major one, and at equal roads the left one the right one.
class RightOfWay {
  public:
    /// [lane] of a junction, the first one of a way through it: the lanes before the junction whose
    /// traffic goes before its own; sorted.
    using Firsts = std::vector<std::vector<std::uint32_t>>;

    /// `crossed`: see is_crossed(), by lane; empty: none.
    RightOfWay(const world::TownT& town, Firsts firsts, std::vector<bool> crossed = {});

    /// Of two lanes of one junction: does who is on the first let who is on the other go, and not
    /// the other one him?
    bool lets_go(std::uint32_t lane, std::uint32_t other) const;

    /// Does somebody else on wheels drive over this lane of a junction? Where one road goes on as
    /// another there is a junction on the map, but none to those who drive there.
    bool is_crossed(std::uint32_t lane) const { return crossed_[lane]; }

  private:
    struct Way {
        std::uint32_t from = world::none;   ///< the lane before the junction
        std::uint32_t first = world::none;  ///< its first lane inside
    };

    bool lets_all_of(const Way& way, std::uint32_t from) const;

    Firsts firsts_;
    std::vector<bool> crossed_;
    std::vector<Way> ways_;  ///< [lane] of a junction
};

/// Of SUMO, which runs by now with the network of this town.
RightOfWay right_of_way_in_sumo(const world::TownT& town);

}  // namespace reprise::traffic

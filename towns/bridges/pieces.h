#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "world/geometry2d.h"

namespace reprise::towns {

/// A straight piece of a track or of a way.
struct Piece {
    std::uint32_t owner = 0;
    Eigen::Vector2d from, to;
    std::string_view way;  ///< its id, of a way
};

/// Cuts a line into pieces of at most 5 m, so that a grid finds few of them near a place. `way`
/// must outlive them.
void add_pieces(const world::Loop& line,
                std::uint32_t owner,
                std::string_view way,
                std::vector<Piece>& pieces);

/// `margin` on all sides. [m]
world::Box box_of(const Piece& piece, double margin);

/// Finds pieces, by their index, near a place.
world::BoxGrid grid_of(const std::vector<Piece>& pieces);

}  // namespace reprise::towns

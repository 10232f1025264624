#include "towns/bridges/pieces.h"

#include <algorithm>
#include <cmath>

namespace reprise::towns {

using Eigen::Vector2d;
using world::Box;
using world::BoxGrid;

namespace {

constexpr double longest_piece = 5;  // [m]

}  // namespace

void add_pieces(const world::Loop& line,
                std::uint32_t owner,
                std::string_view way,
                std::vector<Piece>& pieces) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vector2d along = line[i + 1] - line[i];
        const int count = std::max(1, static_cast<int>(std::ceil(along.norm() / longest_piece)));
        for (int k = 0; k < count; ++k)
            pieces.push_back({owner,
                              line[i] + along * (static_cast<double>(k) / count),
                              line[i] + along * (static_cast<double>(k + 1) / count),
                              way});
    }
}

Box box_of(const Piece& piece, double margin) {
    Box box;
    box.take(piece.from, margin);
    box.take(piece.to, margin);
    return box;
}

BoxGrid grid_of(const std::vector<Piece>& pieces) {
    std::vector<BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        entries.push_back({box_of(pieces[i], 0), i});
    return BoxGrid(entries);
}

}  // namespace reprise::towns

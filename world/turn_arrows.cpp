// Shapes and sizes after the arrows of 5 m for roads in towns that most of Europe has, from
// rectangles and triangles: within 15 cm of them.
#include "world/turn_arrows.h"

#include <algorithm>

#include "world/tick.h"

namespace reprise::world {

namespace {

constexpr double arrow_length = 5.0;    ///< [m]
constexpr double before_end = 7.0;      ///< [m] from the tip to the lane's end
constexpr double next_arrow = 24.0;     ///< [m] between arrows
constexpr double half_shaft = 0.075;    ///< [m]
constexpr double head_length = 1.6;     ///< [m] of the straight head
constexpr double half_head = 0.38;      ///< [m]
constexpr double side_head = 0.75;      ///< [m] of a turn's head, across the lane
constexpr double half_side_head = 0.7;  ///< [m] of the same, along the lane
constexpr double elbow = 2.9;           ///< [m] from the arrow's foot to a turn's shaft

struct Turns {
    bool left = false;
    bool straight = false;
    bool right = false;

    int count() const { return int{left} + int{straight} + int{right}; }

    void take(const Turns& other) {
        left = left || other.left;
        straight = straight || other.straight;
        right = right || other.right;
    }
};

Turns turns_of(const LaneT& lane) {
    Turns turns;
    for (const Link& link : lane.links) {
        const Turn turn = link.turn();
        turns.left = turns.left || turn == Turn::left || turn == Turn::partially_left;
        turns.right = turns.right || turn == Turn::right || turn == Turn::partially_right;
        turns.straight = turns.straight || turn == Turn::straight;
    }
    return turns;
}

/// Do lanes side by side lead to different turns? Neighbours are found from lane to lane.
bool has_a_choice(const TownT& town, std::uint32_t lane) {
    Turns all = turns_of(town.lanes[lane]);
    int lanes = 1;
    for (std::uint32_t i = town.lanes[lane].left; i != none; i = town.lanes[i].left, ++lanes)
        all.take(turns_of(town.lanes[i]));
    for (std::uint32_t i = town.lanes[lane].right; i != none; i = town.lanes[i].right, ++lanes)
        all.take(turns_of(town.lanes[i]));
    return lanes > 1 && all.count() > 1;
}

/// A turn to one side: +1 left, -1 right.
void paint_side(const Line& centre, double foot, double side, Paint& paint) {
    const double at = foot + elbow;
    const double shaft_end = 0.3;  // [m] of the cross shaft, from the middle
    paint.shape(centre,
                {{at - half_shaft, side * half_shaft},
                 {at + half_shaft, side * half_shaft},
                 {at + half_shaft + 0.35, side * shaft_end},
                 {at - half_shaft + 0.35, side * shaft_end}});
    paint.shape(centre,
                {{at + 0.35 - half_side_head, side * shaft_end},
                 {at + 0.35 + half_side_head, side * shaft_end},
                 {at + 0.55, side * (shaft_end + side_head)}});
}

void paint_arrow(const Line& centre, double tip, const Turns& turns, Paint& paint) {
    const double foot = tip - arrow_length;
    const double shaft = turns.straight ? tip - head_length : foot + elbow + half_shaft;
    paint.shape(
        centre,
        {{foot, -half_shaft}, {shaft, -half_shaft}, {shaft, half_shaft}, {foot, half_shaft}});
    if (turns.straight)
        paint.shape(centre, {{shaft, -half_head}, {tip, 0}, {shaft, half_head}});
    if (turns.left)
        paint_side(centre, foot, 1, paint);
    if (turns.right)
        paint_side(centre, foot, -1, paint);
}

}  // namespace

void paint_turn_arrows(const TownT& town, std::uint32_t lane, const Line& centre, Paint& paint) {
    const Turns turns = turns_of(town.lanes[lane]);
    if (turns.count() == 0 || !has_a_choice(town, lane))
        return;
    const double first = length_of(centre) - before_end;
    for (const double tip : {first, first - next_arrow})
        if (tip - arrow_length > 1)
            paint_arrow(centre, tip, turns, paint);
}

}  // namespace reprise::world

// Shapes and sizes after the arrows of 5 m for roads in towns that most of Europe has, from
// rectangles and triangles: within 15 cm of them.
#include "ground/paint/turn_arrows.h"

#include <algorithm>

#include "world/tick.h"

namespace reprise::ground {

namespace {

constexpr double arrow_length = 5.0;    ///< [m]
constexpr double before_end = 7.0;      ///< [m] from the tip to the lane's end
constexpr double next_arrow = 24.0;     ///< [m] between arrows
constexpr double half_shaft = 0.075;    ///< [m]
constexpr double head_length = 1.6;     ///< [m] of the straight head
constexpr double half_head = 0.38;      ///< [m]
constexpr double cross_shaft = 0.5;     ///< [m] of a turn, from the lane's middle to its head
constexpr double side_head = 0.7;       ///< [m] of a turn's head, across the lane
constexpr double half_side_head = 0.7;  ///< [m] of the same, along the lane
constexpr double slant = 0.3;           ///< [m] by which a turn's shaft leans ahead
constexpr double elbow = 2.9;           ///< [m] from the arrow's foot to a turn's shaft
constexpr double early_elbow = 1.3;     ///< [m] the same below a straight head

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

Turns turns_of(const world::LaneT& lane) {
    Turns turns;
    for (const world::Link& link : lane.links) {
        const world::Turn turn = link.turn();
        turns.left = turns.left || turn == world::Turn::left || turn == world::Turn::partially_left;
        turns.right =
            turns.right || turn == world::Turn::right || turn == world::Turn::partially_right;
        turns.straight = turns.straight || turn == world::Turn::straight;
    }
    return turns;
}

/// Do lanes side by side lead to different turns? Neighbours are found from lane to lane.
bool has_a_choice(const world::TownT& town, std::uint32_t lane) {
    Turns all = turns_of(town.lanes[lane]);
    int lanes = 1;
    for (std::uint32_t i = town.lanes[lane].left; i != world::none; i = town.lanes[i].left, ++lanes)
        all.take(turns_of(town.lanes[i]));
    for (std::uint32_t i = town.lanes[lane].right; i != world::none;
         i = town.lanes[i].right, ++lanes)
        all.take(turns_of(town.lanes[i]));
    return lanes > 1 && all.count() > 1;
}

/// A turn to one side (+1 left, -1 right) whose shaft leaves the arrow's own at s = `from`.
void paint_side(const Line& centre, double from, double side, Paint& paint) {
    const double to = from + slant;
    constexpr double half = 1.6 * half_shaft;  // seen slantwise from a car
    paint.shape(centre,
                {{from - half, 0},
                 {from + half, 0},
                 {to + half, side * cross_shaft},
                 {to - half, side * cross_shaft}});
    paint.shape(centre,
                {{to - half_side_head, side * cross_shaft},
                 {to + half_side_head, side * cross_shaft},
                 {to + slant, side * (cross_shaft + side_head)}});
}

void paint_arrow(const Line& centre, double tip, const Turns& turns, Paint& paint) {
    const double foot = tip - arrow_length;
    const double turn = foot + (turns.straight ? early_elbow : elbow);
    const double shaft = turns.straight ? tip - head_length : turn;
    paint.shape(
        centre,
        {{foot, -half_shaft}, {shaft, -half_shaft}, {shaft, half_shaft}, {foot, half_shaft}});
    if (turns.straight)
        paint.shape(centre, {{shaft, -half_head}, {tip, 0}, {shaft, half_head}});
    if (turns.left)
        paint_side(centre, turn, 1, paint);
    if (turns.right)
        paint_side(centre, turn, -1, paint);
}

}  // namespace

void paint_turn_arrows(const world::TownT& town,
                       std::uint32_t lane,
                       const Line& centre,
                       Paint& paint) {
    const Turns turns = turns_of(town.lanes[lane]);
    if (turns.count() == 0 || !has_a_choice(town, lane))
        return;
    const double first = length_of(centre) - before_end;
    for (const double tip : {first, first - next_arrow})
        if (tip - arrow_length > 1)
            paint_arrow(centre, tip, turns, paint);
}

}  // namespace reprise::ground

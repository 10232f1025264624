#include "drivers/way/tight_ways.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::drivers {

namespace {

constexpr double within = 8;   // [m]
constexpr double most = 2.18;  // [rad]

/// Where the way turns, how far along it, and by how much. [m], [rad] to the left
struct Bend {
    double at = 0;
    double turn = 0;
};

std::vector<Bend> bends_of(const world::TownT& town, std::span<const std::uint32_t> lanes) {
    constexpr double same = 0.05;  // [m] what is shorter points nowhere
    std::vector<Bend> bends;
    Eigen::Vector2d last(0, 0), ahead(0, 0);
    double driven = 0;
    bool first = true;
    for (const std::uint32_t lane : lanes)
        for (const world::Vec3& point : town.lanes[lane].centre) {
            const Eigen::Vector2d place = world::in_plan(point);
            const Eigen::Vector2d step = place - last;
            if (!first && step.norm() < same)
                continue;
            if (!first) {
                if (!ahead.isZero())
                    bends.push_back(
                        {driven, std::atan2(world::cross(ahead, step), ahead.dot(step))});
                driven += step.norm();
                ahead = step;
            }
            first = false;
            last = place;
        }
    return bends;
}

}  // namespace

bool is_tight(const world::TownT& town, std::span<const std::uint32_t> lanes) {
    const std::vector<Bend> bends = bends_of(town, lanes);
    for (auto begin = bends.begin(); begin != bends.end(); ++begin) {
        double turned = 0;
        for (auto bend = begin; bend != bends.end() && bend->at <= begin->at + within; ++bend) {
            turned += bend->turn;
            if (std::abs(turned) > most)
                return true;
        }
    }
    return false;
}

}  // namespace reprise::drivers

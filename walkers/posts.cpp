#include "walkers/posts.h"

#include <algorithm>

#include "world/models/catalogue.h"

namespace reprise::walkers {

std::vector<Body> posts_beside(const WalkMap& map, std::span<const world::Obstacle> obstacles) {
    constexpr double step_over = 0.1;  // [m] what is lower is in nobody's way
    constexpr double beside = 0.1;     // [m] that a body is wider than the thing
    double widest = 0;
    for (const world::WalkerModel& model : world::walker_models())
        widest = std::max(widest, model.shoulder_width / 2);
    std::vector<Body> posts;
    for (const world::Obstacle& obstacle : obstacles) {
        if (obstacle.shape != world::Obstacle::Shape::cylinder || 2 * obstacle.half.z() < step_over)
            continue;
        const Eigen::Vector2d foot = obstacle.position.head<2>();
        const auto edge = map.nearest(obstacle.position);
        const double radius = obstacle.radius + beside;
        if (edge && (edge->position.head<2>() - foot).norm() < radius + widest)
            posts.push_back({foot, {0, 0}, radius, 0});
    }
    return posts;
}

}  // namespace reprise::walkers

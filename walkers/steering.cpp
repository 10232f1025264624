#include "walkers/steering.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <recastnavigation/DetourObstacleAvoidance.h>

#include "walkers/map/owned.h"
#include "world/check.h"

namespace reprise::walkers {

namespace {

using Vector = std::array<float, 3>;

/// Recast's axes: x east, y up, z south.
Vector to_detour(const Eigen::Vector2d& v) {
    return {static_cast<float>(v.x()), 0, static_cast<float>(-v.y())};
}

dtObstacleAvoidanceParams parameters() {
    dtObstacleAvoidanceParams parameters{};
    parameters.velBias = 0.4F;
    parameters.weightDesVel = 2;
    parameters.weightCurVel = 0.75F;
    parameters.weightSide = 0.75F;
    parameters.weightToi = 2.5F;
    parameters.horizTime = 2;  // [s]
    parameters.gridSize = 33;
    parameters.adaptiveDivs = 7;  // odd: of an even number Detour leaves one sample to chance
    parameters.adaptiveRings = 2;
    parameters.adaptiveDepth = 2;
    return parameters;
}

using Avoidance = Owned<dtObstacleAvoidanceQuery, dtFreeObstacleAvoidanceQuery>;
using Samples = Owned<dtObstacleAvoidanceDebugData, dtFreeObstacleAvoidanceDebugData>;

}  // namespace

struct Steering::Query {
    Avoidance avoidance{dtAllocObstacleAvoidanceQuery()};
    dtObstacleAvoidanceParams parameters = walkers::parameters();
};

Steering::Steering() : query_(std::make_unique<Query>()) {
    REPRISE_CHECK(query_->avoidance->init(most_around, 0), "walkers: no memory for avoidance");
}

Steering::~Steering() = default;
Steering::Steering(Steering&&) noexcept = default;
Steering& Steering::operator=(Steering&&) noexcept = default;

Eigen::Vector2d Steering::choose(const Body& self,
                                 const Eigen::Vector2d& wanted,
                                 std::span<const Body> around) {
    constexpr double elbow_room = 0.1;  // [m]
    dtObstacleAvoidanceQuery& query = *query_->avoidance;
    query.reset();
    for (const Body& body : around.first(std::min(around.size(), most_around))) {
        const Vector velocity = to_detour(body.velocity);
        query.addCircle(to_detour(body.place - self.place).data(),
                        static_cast<float>(body.radius + elbow_room),
                        velocity.data(),
                        velocity.data());
    }
    Vector chosen{};
    query.sampleVelocityAdaptive(Vector{}.data(),
                                 static_cast<float>(self.radius + elbow_room),
                                 static_cast<float>(wanted.norm()),
                                 to_detour(self.velocity).data(),
                                 to_detour(wanted).data(),
                                 chosen.data(),
                                 &query_->parameters);
    return {static_cast<double>(chosen[0]), static_cast<double>(-chosen[2])};
}

bool detour_uses_our_maths() {
    // Its samples lie on rings around the wanted velocity, an even angle apart: turned by the sine
    // and the cosine of that angle. Those of every other ring are turned by half of it.
    const Avoidance avoidance(dtAllocObstacleAvoidanceQuery());
    const Samples samples(dtAllocObstacleAvoidanceDebugData());
    constexpr int most_samples = 512;
    if (!avoidance->init(1, 0) || !samples->init(most_samples))
        return false;
    for (unsigned char divisions = 3; divisions <= 31; divisions += 2) {
        dtObstacleAvoidanceParams pattern{};  // without weights every sample is looked at
        pattern.horizTime = 1;
        pattern.adaptiveDivs = divisions;
        pattern.adaptiveRings = 1;
        pattern.adaptiveDepth = 1;
        const Vector ahead{1, 0, 0};
        Vector chosen{};
        avoidance->reset();
        avoidance->sampleVelocityAdaptive(Vector{}.data(),
                                          0.3F,
                                          1,
                                          ahead.data(),
                                          ahead.data(),
                                          chosen.data(),
                                          &pattern,
                                          samples.get());
        // The middle, then (1, 0), then that turned to one side.
        if (samples->getSampleCount() < 3)
            return false;
        const volatile float angle = 1.0F / static_cast<float>(divisions) * 3.14159265F * 2;
        const float* turned = samples->getSampleVelocity(2);
        if (std::bit_cast<std::uint32_t>(std::abs(turned[0])) !=
            std::bit_cast<std::uint32_t>(std::abs(std::cos(angle))))
            return false;
    }
    return true;
}

}  // namespace reprise::walkers

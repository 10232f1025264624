#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <vector>

#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourCrowd.h>

#include "ground/mesh/build_ground.h"
#include "ground/obstacles.h"
#include "walkers/map/walk_tiles.h"
#include "world/random.h"
#include "world/town.h"

namespace reprise::bench {

/// What dtCrowd costs by itself: the town's ground as one navigation mesh, with agents that wander
/// at 1.3 m/s.
class BareCrowd {
  public:
    BareCrowd(const world::TownT& town, int agents)
        : mesh_(dtAllocNavMesh(), dtFreeNavMesh),
          crowd_(dtAllocCrowd(), dtFreeCrowd) {
        const ground::GroundMesh ground = ground::build_ground(town);
        const std::vector<world::Obstacle> obstacles = ground::obstacles_of(town);
        walkers::TileRules rules;
        rules.cell = 0.2F;
        rules.radius = 2;
        rules.heights = false;
        const walkers::WalkTiles tiles(ground, rules, obstacles);
        dtNavMeshParams params{};
        params.tileWidth = params.tileHeight = static_cast<float>(tiles.edge());
        params.maxTiles = tiles.columns() * tiles.rows();
        params.maxPolys = 4096;
        mesh_->init(&params);
        for (int row = 0; row < tiles.rows(); ++row)
            for (int column = 0; column < tiles.columns(); ++column)
                add(tiles.build(column, row));
        crowd_->init(agents, 0.3F, mesh_.get());
        for (int i = 0; i < agents; ++i) {
            dtCrowdAgentParams walker{};
            walker.radius = 0.3F;
            walker.height = 1.8F;
            walker.maxAcceleration = 4;
            walker.maxSpeed = 1.3F;
            walker.collisionQueryRange = 3;
            walker.pathOptimizationRange = 10;
            walker.separationWeight = 1;
            walker.updateFlags = DT_CROWD_ANTICIPATE_TURNS | DT_CROWD_OBSTACLE_AVOIDANCE |
                                 DT_CROWD_SEPARATION | DT_CROWD_OPTIMIZE_VIS;
            float place[3];
            draw(i, 0, place);
            crowd_->addAgent(place, &walker);
        }
    }

    void tick(int index) {
        if (index % 1000 == 0)
            for (int i = 0; i < crowd_->getAgentCount(); ++i) {
                float place[3];
                crowd_->requestMoveTarget(i, draw(i, index + 1, place), place);
            }
        crowd_->update(0.05F, nullptr);
    }

  private:
    void add(const walkers::WalkTile& tile) {
        if (tile.bytes.empty())
            return;
        auto* data = static_cast<unsigned char*>(dtAlloc(tile.bytes.size(), DT_ALLOC_PERM));
        std::memcpy(data, tile.bytes.data(), tile.bytes.size());
        const int size = static_cast<int>(tile.bytes.size());
        mesh_->addTile(data, size, DT_TILE_FREE_DATA, 0, nullptr);
        const auto* header = reinterpret_cast<const dtMeshHeader*>(data);
        for (int i = 0; i < 3; ++i) {
            low_[i] = std::min(low_[i], header->bmin[i]);
            high_[i] = std::max(high_[i], header->bmax[i]);
        }
    }

    dtPolyRef draw(int agent, int item, float* place) {
        const auto drawn = [&](std::uint64_t axis) {
            return static_cast<float>(world::draw(static_cast<std::uint64_t>(item),
                                                  axis,
                                                  world::Purpose::walker_place,
                                                  static_cast<std::uint64_t>(agent)));
        };
        const float near[3] = {low_[0] + drawn(0) * (high_[0] - low_[0]),
                               0,
                               low_[2] + drawn(1) * (high_[2] - low_[2])};
        const float reach[3] = {60, 5, 60};
        dtPolyRef polygon = 0;
        crowd_->getNavMeshQuery()->findNearestPoly(
            near, reach, crowd_->getFilter(0), &polygon, place);
        return polygon;
    }

    std::unique_ptr<dtNavMesh, void (*)(dtNavMesh*)> mesh_;
    std::unique_ptr<dtCrowd, void (*)(dtCrowd*)> crowd_;
    float low_[3] = {1e9F, 1e9F, 1e9F};
    float high_[3] = {-1e9F, -1e9F, -1e9F};
};

}  // namespace reprise::bench

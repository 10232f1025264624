#include "kernel/physics/ground.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "kernel/physics/ground_shape.h"
#include "kernel/physics/ray_grid.h"
#include "towns/town_reader.h"
#include "world/random.h"

namespace reprise::kernel {
namespace {

double between(double low, double high, std::uint64_t trial, std::uint64_t item) {
    return low + (high - low) * world::draw(7, trial, world::Purpose::scenario, item);
}

/// Town 1's ground in Bullet, without a world.
class TownGround {
  public:
    TownGround() {
        const std::string town = REPRISE_SOURCE "/scenarios/towns/town1/town1.net.xml";
        const towns::Network network = towns::load_network(town);
        const ground::GroundMesh mesh = ground::build_ground(towns::read_town(network));
        for (const auto& t : mesh.triangles) {
            corners.push_back({to_bullet(mesh.vertices[t[0]]),
                               to_bullet(mesh.vertices[t[1]]),
                               to_bullet(mesh.vertices[t[2]])});
            for (const btVector3& corner : corners.back()) {
                index_.push_back(static_cast<int>(vertices_.size() / 3));
                vertices_.insert(vertices_.end(), {corner.x(), corner.y(), corner.z()});
            }
        }
        arrays_ = std::make_unique<btTriangleIndexVertexArray>(static_cast<int>(corners.size()),
                                                               index_.data(),
                                                               int{3 * sizeof(int)},
                                                               static_cast<int>(index_.size()),
                                                               vertices_.data(),
                                                               int{3 * sizeof(btScalar)});
        shape = std::make_unique<GroundShape>(arrays_.get(), true);
    }

    std::vector<RayGrid::Corners> corners;
    std::unique_ptr<GroundShape> shape;

  private:
    std::vector<int> index_;
    std::vector<btScalar> vertices_;
    std::unique_ptr<btTriangleIndexVertexArray> arrays_;
};

/// On a triangle drawn for this trial, at most `above` over it.
btVector3 near_a_triangle(const TownGround& town, std::uint64_t trial, double above) {
    const auto& corners =
        town.corners[world::draw_index(town.corners.size(), 7, trial, world::Purpose::scenario, 0)];
    const double u = between(0, 1, trial, 1);
    const double v = between(0, 1 - u, trial, 2);
    return corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v +
           btVector3(0, 0, between(0, above, trial, 3));
}

class Offered : public btTriangleCallback {
  public:
    void processTriangle(btVector3*, int, int triangle) override { triangles.push_back(triangle); }

    std::vector<int> sorted() {
        std::sort(triangles.begin(), triangles.end());
        return triangles;
    }

    std::vector<int> triangles;
};

TEST(RayGrid, OffersARayTheTrianglesThatBulletsHierarchyOffers) {
    const TownGround town;
    const RayGrid grid(*town.shape->getOptimizedBvh(), town.corners);
    std::size_t offered = 0;
    for (std::uint64_t trial = 0; trial < 20000; ++trial) {
        const btVector3 from = near_a_triangle(town, trial, 1);
        // Upright as a wheel's, leaning, and flat as of a car on its side.
        const double lean = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 0.3 : 2;
        const btVector3 to = from + btVector3(between(-lean, lean, trial, 4),
                                              between(-lean, lean, trial, 5),
                                              between(-1.2, 0.2, trial, 6));
        Offered ours;
        Offered bullets;
        grid.cast(ours, from, to);
        town.shape->performRaycast(&bullets, from, to);
        std::vector<int> once = ours.sorted();
        once.erase(std::unique(once.begin(), once.end()), once.end());
        ASSERT_EQ(once, bullets.sorted()) << "trial " << trial;
        offered += once.size();
    }
    EXPECT_GT(offered, 20000U);
}

struct Contact {
    btVector3 on_ground;
    btScalar distance;

    bool operator==(const Contact&) const = default;
};

/// What Bullet finds between a box, child of a compound as a car's is, and the ground.
std::vector<Contact> contacts(GroundShape& ground, const btTransform& pose, bool by_ours) {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher(&configuration);
    BoxOnGround::Maker box_on_ground(false);
    BoxOnGround::Maker ground_under_box(true);
    if (by_ours) {
        dispatcher.registerCollisionCreateFunc(
            BOX_SHAPE_PROXYTYPE, TRIANGLE_MESH_SHAPE_PROXYTYPE, &box_on_ground);
        dispatcher.registerCollisionCreateFunc(
            TRIANGLE_MESH_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE, &ground_under_box);
    }
    btDbvtBroadphase pairs;
    btCollisionWorld world(&dispatcher, &pairs, &configuration);
    btBoxShape box(btVector3(2.3, 0.9, 0.6));
    btCompoundShape compound(false);
    compound.addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 0.1)), &box);
    btCollisionObject car;
    car.setCollisionShape(&compound);
    car.setWorldTransform(pose);
    btCollisionObject road;
    road.setCollisionShape(&ground);
    world.addCollisionObject(&road);
    world.addCollisionObject(&car);
    world.performDiscreteCollisionDetection();
    std::vector<Contact> found;
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
        const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
        for (int k = 0; k < manifold.getNumContacts(); ++k)
            found.push_back({manifold.getContactPoint(k).m_positionWorldOnB,
                             manifold.getContactPoint(k).getDistance()});
    }
    world.removeCollisionObject(&car);
    world.removeCollisionObject(&road);
    return found;
}

btTransform drawn_pose(const TownGround& town, std::uint64_t trial) {
    const double tilt = trial % 4 == 0 ? 3.1 : 0.2;  // on its roof or side, or over a kerb
    btQuaternion turn;
    turn.setEuler(between(-tilt, tilt, trial, 4),
                  between(-tilt, tilt, trial, 5),
                  between(-3.1, 3.1, trial, 6));
    return btTransform(turn, near_a_triangle(town, trial, 2));
}

TEST(BoxOnGround, FindsTheContactsThatBulletFinds) {
    const TownGround town;
    std::size_t found = 0;
    for (std::uint64_t trial = 0; trial < 300; ++trial) {
        const btTransform pose = drawn_pose(town, trial);
        const std::vector<Contact> bullets = contacts(*town.shape, pose, false);
        ASSERT_EQ(contacts(*town.shape, pose, true), bullets) << "trial " << trial;
        found += bullets.size();
    }
    EXPECT_GT(found, 100U);
}

TEST(BoxOnGround, IsOfferedFewOfTheTrianglesInATiltedBoxsBounds) {
    const TownGround town;
    std::size_t all = 0;
    std::size_t near = 0;
    for (std::uint64_t trial = 0; trial < 3000; ++trial) {
        const btVector3 half(2.26, 0.86, 0.56);
        const btTransform pose = drawn_pose(town, trial);
        btVector3 low;
        btVector3 high;
        btTransformAabb(half, 0.15, pose, low, high);
        Offered in_bounds;
        town.shape->processAllTriangles(&in_bounds, low, high);
        const GroundShape::Box box{pose.inverse(), half, 0.15};
        town.shape->look_at(&box);
        Offered offered;
        town.shape->processAllTriangles(&offered, low, high);
        town.shape->look_at(nullptr);
        all += in_bounds.triangles.size();
        near += offered.triangles.size();
    }
    EXPECT_LT(near * 3, all * 2) << near << " of " << all;
}

}  // namespace
}  // namespace reprise::kernel

#include "kernel/physics/bullet/convex_pair.h"

#include <memory>
#include <vector>

#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <gtest/gtest.h>

#include "world/random.h"

namespace reprise::kernel {
namespace {

double drawn_between(double low, double high, std::uint64_t trial, std::uint64_t item) {
    return low + (high - low) * world::draw(11, trial, world::Purpose::scenario, item);
}

struct Touch {
    btVector3 on_second;
    btVector3 normal;
    btScalar distance;

    bool operator==(const Touch&) const = default;
};

/// Finds contacts by Bullet's own choice of algorithms, or by ours.
class Finder {
  public:
    explicit Finder(bool by_ours) : dispatcher_(&configuration_) {
        for (const int other :
             {CYLINDER_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE, TRIANGLE_SHAPE_PROXYTYPE})
            if (by_ours) {
                dispatcher_.registerCollisionCreateFunc(BOX_SHAPE_PROXYTYPE, other, &maker_);
                dispatcher_.registerCollisionCreateFunc(other, BOX_SHAPE_PROXYTYPE, &maker_);
            }
    }

    std::vector<Touch> touches(btCollisionShape& one,
                               const btTransform& pose_of_one,
                               btCollisionShape& other,
                               const btTransform& pose_of_other) {
        btCollisionObject first;
        first.setCollisionShape(&one);
        first.setWorldTransform(pose_of_one);
        btCollisionObject second;
        second.setCollisionShape(&other);
        second.setWorldTransform(pose_of_other);
        world_.addCollisionObject(&first);
        world_.addCollisionObject(&second);
        world_.performDiscreteCollisionDetection();
        std::vector<Touch> found;
        for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
            const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
            for (int k = 0; k < manifold.getNumContacts(); ++k) {
                const btManifoldPoint& point = manifold.getContactPoint(k);
                found.push_back(
                    {point.m_positionWorldOnB, point.m_normalWorldOnB, point.getDistance()});
            }
        }
        world_.removeCollisionObject(&first);
        world_.removeCollisionObject(&second);
        return found;
    }

  private:
    btDefaultCollisionConfiguration configuration_;
    ConvexPair::Maker maker_;
    btCollisionDispatcher dispatcher_;
    btDbvtBroadphase pairs_;
    btCollisionWorld world_{&dispatcher_, &pairs_, &configuration_};
};

std::unique_ptr<btCollisionShape> drawn_shape(std::uint64_t trial) {
    const double size = drawn_between(0.04, 2, trial, 0);
    const double height = drawn_between(0.3, 3, trial, 1);
    switch (trial % 3) {
        case 0:  // a pole, a bush
            return std::make_unique<btCylinderShapeZ>(btVector3(size, size, height));
        case 1: {  // a part of a building
            auto prism = std::make_unique<btConvexHullShape>();
            for (std::uint64_t corner = 0; corner < 3; ++corner)
                for (const double side : {-1.0, 1.0})
                    prism->addPoint(btVector3(drawn_between(-4, 4, trial, 2 + corner),
                                              drawn_between(-4, 4, trial, 5 + corner),
                                              side * height));
            return prism;
        }
        default:  // of the ground
            return std::make_unique<btTriangleShape>(
                btVector3(drawn_between(-9, 9, trial, 2), drawn_between(-9, 9, trial, 3), 0),
                btVector3(drawn_between(-9, 9, trial, 4), drawn_between(-9, 9, trial, 5), 0.1),
                btVector3(drawn_between(-9, 9, trial, 6), drawn_between(-9, 9, trial, 7), 0));
    }
}

/// Upright, leaning, on its side; in the middle of a town, where numbers have fewer digits left.
btTransform pose_by(std::uint64_t trial, std::uint64_t first_item, double reach, double tilt) {
    btQuaternion turn;
    turn.setEuler(drawn_between(-tilt, tilt, trial, first_item),
                  drawn_between(-tilt, tilt, trial, first_item + 1),
                  drawn_between(-3.1, 3.1, trial, first_item + 2));
    return btTransform(turn,
                       btVector3(300 + drawn_between(-reach, reach, trial, first_item + 3),
                                 200 + drawn_between(-reach, reach, trial, first_item + 4),
                                 drawn_between(-1, 1, trial, first_item + 5)));
}

TEST(ConvexPair, FindsTheContactsThatBulletFinds) {
    Finder ours(true);
    Finder bullet(false);
    std::size_t touching = 0;
    std::size_t deep = 0;
    for (std::uint64_t trial = 0; trial < 9000; ++trial) {
        btBoxShape box(btVector3(2.3, 0.9, 0.6));
        const btTransform pose_of_box = pose_by(trial, 10, 3, trial % 2 == 0 ? 0.1 : 3.1);
        const auto other = drawn_shape(trial);
        const btTransform pose_of_other = pose_by(trial, 20, 0, 0);
        const auto bullets = bullet.touches(box, pose_of_box, *other, pose_of_other);
        ASSERT_EQ(ours.touches(box, pose_of_box, *other, pose_of_other), bullets)
            << "trial " << trial;
        touching += bullets.size();
        deep += !bullets.empty() && bullets.front().distance < -0.08 ? 1 : 0;
    }
    EXPECT_GT(touching, 2000U);
    EXPECT_GT(deep, 500U);
}

TEST(ConvexPair, FindsThemAsWellWhenTheBoxComesSecond) {
    Finder ours(true);
    Finder bullet(false);
    for (std::uint64_t trial = 0; trial < 3000; ++trial) {
        btBoxShape box(btVector3(2.3, 0.9, 0.6));
        const btTransform pose_of_box = pose_by(trial, 10, 3, trial % 2 == 0 ? 0.1 : 3.1);
        const auto other = drawn_shape(trial);
        const btTransform pose_of_other = pose_by(trial, 20, 0, 0);
        ASSERT_EQ(ours.touches(*other, pose_of_other, box, pose_of_box),
                  bullet.touches(*other, pose_of_other, box, pose_of_box))
            << "trial " << trial;
    }
}

/// Contacts at the very limit of what counts as one: the closer look must not leave any out.
TEST(ConvexPair, FindsThoseThatAreNearlyTooFarToCount) {
    Finder ours(true);
    Finder bullet(false);
    const btScalar both_margins_and_threshold = 0.02;
    std::size_t found = 0;
    for (std::uint64_t trial = 0; trial < 3000; ++trial) {
        btBoxShape box(btVector3(2.3, 0.9, 0.6));
        btCylinderShapeZ pole(btVector3(0.1, 0.1, 1.5));
        const btTransform pose_of_box = pose_by(trial, 10, 0, 0.1);
        const double angle = drawn_between(-3.1, 3.1, trial, 30);
        // Moved out along one direction until about a contact's threshold is between the two.
        const btVector3 out(btCos(angle), btSin(angle), 0);
        const btVector3 in_box = out * pose_of_box.getBasis();
        btTransform pose_of_pole = pose_of_box;
        pose_of_pole.setBasis(btMatrix3x3::getIdentity());
        pose_of_pole.setOrigin(
            pose_of_box(box.localGetSupportingVertex(in_box)) +
            out * (0.1 + both_margins_and_threshold + drawn_between(-0.02, 0.01, trial, 31)));
        const auto bullets = bullet.touches(box, pose_of_box, pole, pose_of_pole);
        ASSERT_EQ(ours.touches(box, pose_of_box, pole, pose_of_pole), bullets) << trial;
        found += bullets.size();
    }
    EXPECT_GT(found, 500U);
    EXPECT_LT(found, 2900U);
}

}  // namespace
}  // namespace reprise::kernel

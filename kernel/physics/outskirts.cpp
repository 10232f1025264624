#include "kernel/physics/outskirts.h"

#include <algorithm>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

namespace reprise::kernel {

namespace {

constexpr double inside = 0.01;  ///< [m] of the border: there the mesh is for certain
constexpr double beside = 1;     ///< [m] that triangles reach beyond the bounds they are asked for

class FirstOfAll : public btTriangleRaycastCallback {
  public:
    FirstOfAll(const btVector3& from, const btVector3& to) : btTriangleRaycastCallback(from, to) {}

    btScalar reportHit(const btVector3&, btScalar fraction, int, int) override {
        best = std::min(best, fraction);
        return best;
    }

    btScalar best = 1;
};

}  // namespace

double Outskirts::height(const btVector3& p) const {
    const btVector3 margin(inside, inside, 0);
    btVector3 border = p;
    border.setMax(low_ + margin);
    border.setMin(high_ - margin);
    const btVector3 from(border.x(), border.y(), high_.z() + 1);
    const btVector3 to(border.x(), border.y(), low_.z() - 1);
    FirstOfAll first(from, to);
    rays_->cast(first, from, to);
    return first.best < 1 ? from.z() + (to.z() - from.z()) * first.best : low_.z();
}

void Outskirts::offer(btTriangleCallback& callback,
                      const btVector3& low,
                      const btVector3& high) const {
    const double from_x = low.x() - beside;
    const double to_x = high.x() + beside;
    const double from_y = low.y() - beside;
    const double to_y = high.y() + beside;
    if (low.x() < low_.x())
        offer_level(callback, from_x, std::min(to_x, low_.x()), from_y, to_y);
    if (high.x() > high_.x())
        offer_level(callback, std::max(from_x, high_.x()), to_x, from_y, to_y);
    if (low.y() < low_.y())
        offer_level(callback, from_x, to_x, from_y, std::min(to_y, low_.y()));
    if (high.y() > high_.y())
        offer_level(callback, from_x, to_x, std::max(from_y, high_.y()), to_y);
}

void Outskirts::offer_level(
    btTriangleCallback& callback, double from_x, double to_x, double from_y, double to_y) const {
    const double z = height(btVector3((from_x + to_x) / 2, (from_y + to_y) / 2, 0));
    const btVector3 corner(from_x, from_y, z);
    const btVector3 right(to_x, from_y, z);
    const btVector3 opposite(to_x, to_y, z);
    const btVector3 left(from_x, to_y, z);
    btVector3 one[3] = {corner, right, opposite};
    btVector3 other[3] = {corner, opposite, left};
    callback.processTriangle(one, 0, 0);
    callback.processTriangle(other, 0, 0);
}

}  // namespace reprise::kernel

#include "towns/furnish/parapets.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "towns/furnish/roadside.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/units.h"

namespace reprise::towns {

namespace {

using Eigen::Vector3d;
using world::LaneKind;
using world::LaneT;

constexpr double step = 1;          // [m] along a road
constexpr std::size_t piece = 2;    // steps of wall: each is level
constexpr std::size_t beyond = 6;   // steps before and behind what passes below
constexpr double beside = 2;        // [m] from a lane below: a fall onto its verge counts
constexpr double thickness = 0.2;   // [m]
constexpr double height = 0.9;      // [m]
constexpr std::uint32_t stone = 1;  // style: no bricks
constexpr double clear = 0.9;       // [m] from a centre line on the wall's own level

/// All that is driven or walked on, piece by piece.
class Roads {
  public:
    explicit Roads(const world::TownT& town) {
        std::vector<world::BoxGrid::Entry> entries;
        for (const LaneT& lane : town.lanes)
            for (std::size_t i = 1; i < lane.centre.size(); ++i) {
                const Stretch stretch{
                    world::to_eigen(lane.centre[i - 1]), world::to_eigen(lane.centre[i]), &lane};
                world::Box box;
                box.take(stretch.from.head<2>(), lane.width / 2 + beside);
                box.take(stretch.to.head<2>(), lane.width / 2 + beside);
                entries.push_back({box, static_cast<std::uint32_t>(stretches_.size())});
                stretches_.push_back(stretch);
            }
        by_place_ = world::BoxGrid(entries);
    }

    bool passes_below(const Vector3d& p) const {
        return any_near(p, [&](const LaneT& lane, double aside, double above) {
            return above < -world::level_clearance && aside < lane.width / 2 + beside;
        });
    }

    /// Is there a road at the height of a wall's foot?
    bool is_driven(const Vector3d& p) const {
        return any_near(p, [&](const LaneT& lane, double aside, double above) {
            const double half =
                lane.kind == LaneKind::internal ? clear + thickness / 2 : lane.width / 2;
            return std::abs(above) < world::level_clearance && lane.kind != LaneKind::sidewalk &&
                   aside < half;
        });
    }

  private:
    struct Stretch {
        Vector3d from, to;
        const LaneT* lane;
    };

    template <typename Test>
    bool any_near(const Vector3d& p, Test&& test) const {
        world::Box box;
        box.take(p.head<2>(), 0.1);
        const std::vector<std::uint32_t> near = by_place_.near(box);
        return std::any_of(near.begin(), near.end(), [&](std::uint32_t index) {
            const Stretch& stretch = stretches_[index];
            const Vector3d along = stretch.to - stretch.from;
            const double square = std::max(along.head<2>().squaredNorm(), 1e-12);
            const double share =
                std::clamp((p - stretch.from).head<2>().dot(along.head<2>()) / square, 0.0, 1.0);
            const Vector3d foot = stretch.from + share * along;
            return test(*stretch.lane, (p - foot).head<2>().norm(), foot.z() - p.z());
        });
    }

    std::vector<Stretch> stretches_;
    world::BoxGrid by_place_;
};

Vector3d at(const Roadside& roadside, double s, double away) {
    const RoadsidePose place = roadside_pose(roadside, s, away);
    return {place.position.x(), place.position.y(), place.z};
}

void add_wall(PlacementContext& context, const Roadside& roadside, double from, double to) {
    const Vector3d start = at(roadside, from, thickness / 2);
    const Vector3d end = at(roadside, to, thickness / 2);
    const Vector3d middle = (start + end) / 2;
    context.town.props.emplace_back(world::Vec3(middle.x(), middle.y(), middle.z()),
                                    std::atan2(end.y() - start.y(), end.x() - start.x()),
                                    (end - start).head<2>().norm(),
                                    thickness,
                                    height,
                                    stone,
                                    std::uint16_t{0},
                                    world::PropKind::wall,
                                    std::uint8_t{0});
}

}  // namespace

void place_parapets(PlacementContext& context) {
    const Roads roads(context.town);
    for (const Roadside& roadside : context.roadsides) {
        const auto count = static_cast<std::size_t>(roadside.border.length / step);
        std::vector<bool> walled(count, false);
        for (std::size_t i = 0; i < count; ++i)
            if (roads.passes_below(at(roadside, (static_cast<double>(i) + 0.5) * step, 0)))
                for (std::size_t k = i - std::min(i, beyond); k < std::min(count, i + beyond); ++k)
                    walled[k] = true;
        for (std::size_t i = 0; i + 1 < count; i += piece) {
            const double s = static_cast<double>(i) * step;
            if ((walled[i] || walled[i + 1]) &&
                !roads.is_driven(at(roadside, s + step, thickness / 2)))
                add_wall(context, roadside, s, s + piece * step);
        }
    }
}

}  // namespace reprise::towns

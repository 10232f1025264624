#include "towns/network/out_of_place.h"

#include <algorithm>

namespace reprise::towns {

namespace {

double median(const std::vector<Eigen::Vector2d>& places, int axis) {
    std::vector<double> all;
    for (const Eigen::Vector2d& place : places)
        all.push_back(place[axis]);
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    return *middle;
}

}  // namespace

std::optional<std::size_t> out_of_place(const std::vector<Eigen::Vector2d>& places) {
    if (places.empty())
        return std::nullopt;
    Eigen::Vector2d low = places.front(), high = low;
    for (const Eigen::Vector2d& place : places) {
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    if ((high - low).maxCoeff() <= widest_town)
        return std::nullopt;
    const Eigen::Vector2d middle(median(places, 0), median(places, 1));
    const auto farthest =
        std::max_element(places.begin(),
                         places.end(),
                         [&](const Eigen::Vector2d& one, const Eigen::Vector2d& other) {
                             return (one - middle).squaredNorm() < (other - middle).squaredNorm();
                         });
    return static_cast<std::size_t>(farthest - places.begin());
}

}  // namespace reprise::towns

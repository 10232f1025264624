#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace reprise::towns {

constexpr double widest_town = 200'000;  ///< [m] of the largest that is built

/// Where things would make a town wider than any can be: the index of the one that lies farthest
/// from the middle (the median) of all. What is made of a town is made for all of its ground.
std::optional<std::size_t> out_of_place(const std::vector<Eigen::Vector2d>& places);

}  // namespace reprise::towns

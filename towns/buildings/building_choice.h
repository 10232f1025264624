#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// How a part of a town is built: the styles of Place::District.
enum class BuildingStyle : std::uint8_t { village, old, brick, modern, centre };

std::optional<BuildingStyle> find_building_style(std::string_view name);

/// Which style is built where: the place's districts (a later one lies over an earlier one); where
/// there are none, centre around the greatest junction, and one drawn for each region of 160 m.
class Districts {
  public:
    explicit Districts(const PlacementContext& context);

    BuildingStyle at(const Eigen::Vector2d& p) const;

    /// The middle of the town: its first square, else its greatest junction.
    const Eigen::Vector2d& middle() const { return middle_; }

  private:
    struct Region {
        BuildingStyle style;
        world::Loop loop;  ///< empty: everywhere
    };

    std::uint64_t seed_;
    Eigen::Vector2d middle_ = Eigen::Vector2d::Zero();
    std::vector<Region> regions_;
};

/// The kind of street a building stands at; together with the style it decides the model.
enum class StreetSetting : std::uint8_t {
    quiet_street,  ///< along a street of one lane and at most 30 km/h
    street,        ///< along any other
    second_row     ///< behind the buildings of a street
};

/// Index in world::building_models(); `drawn` in [0, 1).
std::uint32_t choose_model(BuildingStyle style, StreetSetting street_setting, double drawn);

}  // namespace reprise::towns

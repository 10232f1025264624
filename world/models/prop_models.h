#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace reprise::world {

/// How a prop is drawn, and which box or boxes physics knows of it.
enum class PropForm : std::uint8_t { box, cone, barrier, triangle, plank, tyre, sign };

/// A thing that a scenario puts on the road: it has mass and falls, slides and flies when it is
/// hit. Its frame: origin in the middle of its foot, x along its length. [m], [kg]
struct PropModel {
    const char* name;
    PropForm form;
    double length;
    double width;
    double height;
    double mass;
    double friction;      ///< sliding, of itself on itself; on asphalt the road's factor counts
    std::uint32_t paint;  ///< 0xRRGGBB
};

/// The prop catalogue. An index into it is what ticks record: append only.
std::span<const PropModel> prop_models();

/// A sign of the town that was broken off is a prop from then on: this, and its index in
/// Town.props.
inline constexpr std::uint32_t first_broken_id = 50'000'000;
inline constexpr std::uint32_t last_broken_id = 99'999'999;

/// Index in prop_models().
std::optional<std::uint16_t> find_prop_model(std::string_view name);

}  // namespace reprise::world

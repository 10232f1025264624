#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/overlay/tags.h"
#include "world/external/sensor.h"

namespace reprise::render {

enum class Tone : std::uint8_t { plain, good, bad };

struct OverlayLine {
    std::string text;
    Tone tone = Tone::plain;
};

/// What is written onto a picture beside the tags.
struct OverlayText {
    std::vector<OverlayLine> clock;      ///< upper left: what time it is, how fast who is followed
    std::vector<OverlayLine> events;     ///< lower left, the latest one last
    std::optional<OverlayLine> verdict;  ///< upper middle, larger
};

/// Pixels from (left, top) up to, but without, (right, bottom).
struct Area {
    int left = 0;
    int top = 0;
    int right = 0;
    int bottom = 0;
};

/// Where was written.
struct Written {
    std::vector<Area> tags;   ///< of each tag; empty where there was no room
    std::vector<Area> stems;  ///< from tags that stand higher than their point down to it
    std::vector<Area> text;
};

/// Writes onto an rgb picture, in letters that fit its height and can be read on anything. All
/// pixels outside of what it returns stay as they were. A tag's area stands in the middle over its
/// point, or as near as there is room.
Written write_overlay(world::SensorFrame& picture,
                      std::span<const Tag> tags,
                      const OverlayText& text);

/// The scale of a view from above, and where north is in it: `north` [rad] counter-clockwise from
/// what is right in the picture.
Area write_scale(world::SensorFrame& picture, double metres_per_pixel, double north);

}  // namespace reprise::render

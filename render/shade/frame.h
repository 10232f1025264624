#pragma once

#include <cstdint>
#include <vector>

#include "render/look/look.h"
#include "render/shade/tile_pixels.h"
#include "render/trace/camera.h"

namespace reprise::render {

/// A picture in the making. Kept between frames for its memory only: nothing of an old frame is
/// read.
struct Frame {
    int width = 0;
    int height = 0;
    std::vector<Color> colors;  ///< radiance times exposure
    std::vector<float> tones;   ///< how bright each looks, in [0, 1): before edges are refined
    TilePool pool;

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

/// Shades what `hits` (from trace_primary()) found into frame.colors. Each pixel is a function of
/// the scene and its neighbours' hits, so that the number of threads does not matter.
void shade(const ShadingInput& input,
           const Camera& camera,
           std::uint32_t mask,
           const std::vector<Hit>& hits,
           Frame& frame);

/// Draws falling drops over the colours: streaks, each a function of (tick, number).
void draw_rain(const ShadingInput& input,
               const Camera& camera,
               const std::vector<Hit>& hits,
               Frame& frame);

/// Likewise falling flakes, which stand in the world while the camera moves.
void draw_snow(const ShadingInput& input,
               const Camera& camera,
               const std::vector<Hit>& hits,
               Frame& frame);

/// Drops on the lens of a camera that drives in the rain.
void wet_lens(const ShadingInput& input, Frame& frame);

/// Lets what is brighter than white shine over its edges; `strength` in [0, 1], 0 does nothing.
void add_glare(Frame& frame, float strength);

/// The tone curve of film: what is bright turns pale, what is coloured stays so. To [0, 1].
Color film(const Color& light);

/// Tone curve and sRGB: 3 bytes a pixel.
std::vector<std::uint8_t> tone_map(const Frame& frame, std::uint64_t tick);

}  // namespace reprise::render

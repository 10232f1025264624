// What it must do: light for each row at its own time, as the mean over exposure and opening.
// How it goes: rows that are seen at one instant are shaded as a picture of their own, with a few
//   more above and below for what looks at neighbours. What is averaged is light, not tones.
// What it keeps: nothing.
#include "render/optics/photograph.h"

#include <algorithm>

#include "render/scene/tracer.h"

namespace reprise::render {

namespace {

constexpr int margin = 4;  // [rows] what the filter of light and that of edges look at

}  // namespace

void gather_light(Stage& stage,
                  const Sight& sight,
                  const Shutter& shutter,
                  const std::vector<Band>& bands,
                  const ShadingInput& input,
                  Frame& work,
                  Frame& frame) {
    const int width = sight.now.width();
    const int height = sight.now.height();
    frame.width = width;
    frame.height = height;
    frame.colors.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                        Color::Zero());
    std::vector<Hit> hits;
    for (const Band& band : bands) {
        const int top = std::max(0, band.first - margin);
        const int bottom = std::min(height, band.first + band.rows + margin);
        for (int sample = 0; sample < shutter.samples; ++sample) {
            const double ago = band.ago + (shutter.open > 0 ? shutter.ago(sample) : 0);
            stage.go_back(ago);
            Camera camera = sight.at(stage.share(ago)).cropped(top, bottom - top);
            if (shutter.sharp > 0)
                camera = camera.through(shutter.aside(sample), shutter.sharp);
            trace_primary(stage.scene(), camera, sight.mask, hits);
            shade(input, camera, sight.mask, hits, work);
            const std::size_t from = frame.index(0, band.first);
            const std::size_t count = frame.index(0, band.rows);
            for (std::size_t i = 0; i < count; ++i)
                frame.colors[from + i] += work.colors[work.index(0, band.first - top) + i];
        }
    }
    for (Color& color : frame.colors)
        color /= static_cast<float>(shutter.samples);
}

}  // namespace reprise::render

// What it must do: turn the primary hits into light, in about 0.2 s for 800 x 600 on two cores.
// What it assumes: hits are final; Scene, Sky and beams do not change meanwhile.
// How it goes, tiles in parallel, each stage of one as soon as its neighbours are past the last:
//   1. light: at each hit the look, one ray to the sun, two short ones into the sky's half sphere,
//   and
//      a mirror ray where the surface is glossy. Directions change in a fixed pattern of 4 x 4
//      pixels.
//   2. combine: the mean over 4 x 4 neighbours on the same surface has seen all the pattern's
//      directions, so that little noise is left (interleaved sampling: Keller and Heidrich, 2001).
//   3. refine: pixels on edges are taken again as the mean of two places inside, or of four
//      where the two differ.
// By night the light of lamps and the moon comes in between, see lamp_light.h: one more ray at a
// hit instead of the sun's; and lamps glare.
// What it keeps: nothing.
#include "render/shade/shading_job.h"

namespace reprise::render {

using Eigen::Vector3f;

void shade(const ShadingInput& input,
           const Camera& camera,
           std::uint32_t mask,
           const std::vector<Hit>& hits,
           Frame& frame) {
    frame.width = camera.width();
    frame.height = camera.height();
    frame.colors.resize(hits.size());
    frame.tones.resize(hits.size());
    const Vector3f eye = camera.position().cast<float>();
    const float ambient = luminance(input.sky.ambient(Vector3f::UnitZ()));
    ShadingJob job{input,
                   camera,
                   mask,
                   hits,
                   frame,
                   {},
                   SourceGrid(find_sources(input, eye), eye),
                   false,
                   eye,
                   static_cast<float>(camera.pixel()),
                   sun_directions(input.sky),
                   luminance(input.sky.sun()) / pi > 0.01F * ambient};
    job.lamps_matter = !job.sources.empty() || input.sky.moon().light.maxCoeff() > 0;
    // A tile's next stage comes as soon as its neighbours are so far: what they wrote is still in
    // the cache.
    TileStage lit(camera);
    TileStage combined(camera);
    TileStage refined(camera);
    job.tiles.resize(lit.tiles());
    frame.pool.recall();
    for_tiles(camera, [&](const Eigen::Vector2i& first) {
        job.pixels(first) = frame.pool.take();
        light_tile(job, first);
        lit.finish(first, [&](const Eigen::Vector2i& second) {
            combine_tile(job, second);
            combined.finish(second, [&](const Eigen::Vector2i& third) {
                refine_tile(job, third);
                refined.finish(third, [&](const Eigen::Vector2i& done) {
                    frame.pool.give_back(job.pixels(done));
                });
            });
        });
    });
}

}  // namespace reprise::render

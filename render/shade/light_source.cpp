#include "render/shade/light_source.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// After ECE R112: brightest just below a line half a degree under the horizon, which on the kerb's
/// side rises by 15 degrees; a little is let through above, for signs.
float low_beam_share(const LightSource& source, const Vector3f& way) {
    const float ahead = way.dot(source.axis);
    if (ahead < 0.25F)
        return 0;
    const float side = way.dot(source.left) / ahead;
    const float rise = way.dot(source.axis.cross(source.left)) / ahead;
    const float line = -0.010F + 0.26F * std::min(std::max(-side, 0.0F), 0.12F);
    const float below = line - rise;
    const float cut = smooth_step(-0.008F, 0.008F, below);
    const float drop = std::max(below, 0.0F) / 0.055F;
    const float narrow = side / 0.24F;
    const float wide = side / 0.75F;
    const float across = 0.85F / ((1 + narrow * narrow) * (1 + narrow * narrow)) +
                         0.15F / ((1 + wide * wide) * (1 + wide * wide));
    const float shape =
        mix(0.012F, 1 / (1 + drop * drop * (1 + 0.6F * drop)), cut);  // above, below
    return across * smooth_step(0.25F, 0.5F, ahead) * shape;
}

}  // namespace

float lobe_share(const LightSource& source, const Vector3f& way) {
    switch (source.lobe) {
        case LightSource::Lobe::street:
            return smooth_step(0.10F, 0.42F, -way.z()) * (1.3F + 0.6F * way.z());
        case LightSource::Lobe::lantern:
            return smooth_step(0.75F, 0.2F, way.z());
        case LightSource::Lobe::lens: {
            const float ahead = std::max(0.0F, way.dot(source.axis));
            return ahead * ahead * ahead * ahead;
        }
        case LightSource::Lobe::window:
            return std::max(0.0F, way.dot(source.axis));
        case LightSource::Lobe::low_beam:
            return low_beam_share(source, way);
    }
    return 0;
}

}  // namespace reprise::render

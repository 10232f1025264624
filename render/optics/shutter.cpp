#include "render/optics/shutter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/trace/camera.h"
#include "world/external/sensor_attributes.h"

namespace reprise::render {

namespace {

constexpr double millisecond = 1e-3;
constexpr double longest_band = 0.5 * millisecond;
constexpr int fewest_rows = 8;
constexpr int step_of_rows = 4;  // the pattern of light repeats, see shade/

double told(const world::SensorSpec& spec, const char* name) {
    return world::find_attribute(spec.kind, name) == nullptr ? 0 : world::attribute(spec, name);
}

}  // namespace

Shutter::Shutter(const world::SensorSpec& spec) : readout(told(spec, "readout_time") * 1e-3) {
    if (spec.kind != world::SensorKind::rgb)
        return;
    if (told(spec, "motion_blur") > 0)
        open = 1 / told(spec, "shutter_speed");
    sharp = told(spec, "focal_distance");
    if (sharp > 0) {
        // The sensor is as wide as the picture: of a pinhole's focal length in pixels.
        const double focal = Camera(spec, Eigen::Isometry3d::Identity()).focal() / spec.width *
                             told(spec, "sensor_width") * 1e-3;
        aperture = focal / told(spec, "fstop") / 2;
    }
    if (open > 0 || sharp > 0)
        samples = static_cast<int>(told(spec, "samples"));
}

Eigen::Vector2d Shutter::aside(int sample) const {
    // Roberts' R2 sequence, bent over the disc.
    const auto part = [](double x) { return x - std::floor(x); };
    const double angle = 2 * std::numbers::pi * part((sample + 0.5) * 0.7548776662466927);
    const double far = aperture * std::sqrt(part((sample + 0.5) * 0.5698402909980532));
    return {far * std::cos(angle), far * std::sin(angle)};
}

std::vector<Band> bands_of(const world::SensorSpec& spec) {
    const double readout = Shutter(spec).readout;
    if (readout <= 0)
        return {{0, spec.height, 0}};
    const int wanted = static_cast<int>(spec.height * longest_band / readout);
    const int rows = std::max(fewest_rows, wanted / step_of_rows * step_of_rows);
    std::vector<Band> bands;
    for (int first = 0; first < spec.height; first += rows) {
        const int height = std::min(rows, spec.height - first);
        bands.push_back({first, height, readout * (1 - (first + height / 2.0) / spec.height)});
    }
    return bands;
}

}  // namespace reprise::render

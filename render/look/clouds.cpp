#include "render/look/clouds.h"

#include <algorithm>
#include <cmath>

#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float base_height = 1500;                // [m] of their base
constexpr float unit_length = base_height / 1.3F;  // [m] of the pattern
constexpr double seconds_a_tick = 0.05;
constexpr double wind_aloft = 2;  // how much faster it blows up there

// Shadows: 44 m fine, where the smallest clouds are 70 m wide, within 1.4 km of the eye.
constexpr int shadow_cells = 64;
constexpr float shadow_step = 44 / unit_length;

/// Where a line of sight meets the layer; it is bent down to the horizon.
Vector2f on_layer(const Vector3f& direction) {
    const float away = 1 / (std::max(direction.z(), 0.0F) + 0.12F);
    return direction.head<2>() * away * 1.3F;
}

}  // namespace

Clouds::Clouds(const world::Weather& weather)
    : share_(weather.cloud_cover()),
      // Full sun and a third of it, under half a cover; under a closed one there are no shadows.
      contrast_(3 * share_ * (1 - share_)),
      // The quantiles of the noise, roughly: half the cover at 0.5.
      // A closed cover has no gaps left.
      level_(mix(0.70F, 0.26F, share_) - 0.35F * smooth_step(0.75F, 1, share_)),
      offset_(Vector2f::Zero()),
      eye_(Vector2f::Zero()),
      corner_(Vector2f::Zero()) {
    const auto azimuth = static_cast<double>(weather.wind_azimuth());
    const double speed =
        wind_aloft * static_cast<double>(weather.wind_speed()) / static_cast<double>(unit_length);
    speed_ = Eigen::Vector2d(speed * std::cos(azimuth), speed * std::sin(azimuth)).cast<float>();
}

float Clouds::density(float x, float y) const {
    const float bend = fractal_noise(x * 0.7F + 9, y * 0.7F, 2, 40);
    const float noise = fractal_noise_over(level_, x + 1.1F * bend, y - 0.8F * bend, 5, 50);
    return smooth_step(level_, level_ + 0.22F, noise);
}

void Clouds::look_from(const Vector3f& eye, const Vector3f& to_sun, std::uint64_t tick) {
    const auto time = static_cast<float>(static_cast<double>(tick) * seconds_a_tick);
    eye_ = eye.head<2>();
    offset_ = eye_ / unit_length - speed_ * time;
    if (contrast_ <= 0 || to_sun.z() <= 0) {
        table_.clear();
        return;
    }
    const Vector2f above = offset_ + on_layer(to_sun);
    const int left = floor_int(above.x() / shadow_step) - shadow_cells / 2;
    const int low = floor_int(above.y() / shadow_step) - shadow_cells / 2;
    corner_ = Vector2f(static_cast<float>(left), static_cast<float>(low)) * shadow_step -
              on_layer(to_sun) - offset_;
    fill_table(left, low);
}

/// Factors are functions of their cell alone: of those that the last picture had, too, none is made
/// again. They are a millisecond's work, and from picture to picture a row or none is new.
void Clouds::fill_table(int left, int low) {
    const std::vector<float> last = std::move(table_);
    const int right = left - left_;
    const int up = low - low_;
    const auto is_in = [](int cell) { return cell >= 0 && cell < shadow_cells; };
    table_.resize(static_cast<std::size_t>(shadow_cells) * shadow_cells);
    for (int i = 0; i < shadow_cells * shadow_cells; ++i) {
        const int column = i % shadow_cells;
        const int row = i / shadow_cells;
        float& factor = table_[static_cast<std::size_t>(i)];
        if (!last.empty() && is_in(column + right) && is_in(row + up)) {
            factor = last[static_cast<std::size_t>((row + up) * shadow_cells + column + right)];
            continue;
        }
        const auto x = static_cast<float>(left + column);
        const auto y = static_cast<float>(low + row);
        factor = 1 + contrast_ * (share_ - density(x * shadow_step, y * shadow_step));
    }
    left_ = left;
    low_ = low;
}

float Clouds::cover(const Vector3f& direction) const {
    const Vector2f at = offset_ + on_layer(direction);
    return density(at.x(), at.y());
}

float Clouds::sunlight(const Vector3f& place) const {
    if (table_.empty())
        return 1;
    const Vector2f at = ((place.head<2>() - eye_) / unit_length - corner_) / shadow_step;
    const float x = std::min(std::max(at.x(), 0.0F), shadow_cells - 1.01F);
    const float y = std::min(std::max(at.y(), 0.0F), shadow_cells - 1.01F);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float* four = &table_[static_cast<std::size_t>(row * shadow_cells + column)];
    const float fx = x - static_cast<float>(column);
    return mix(mix(four[0], four[1], fx),
               mix(four[shadow_cells], four[shadow_cells + 1], fx),
               y - static_cast<float>(row));
}

}  // namespace reprise::render

// What it must do: say what a LiDAR's receiver reports of one shot.
// What it assumes: echoes of the shot's rays are final; powers count in those of a white surface,
//   met straight on, one metre away.
// How it goes:
//   1. surfaces: each ray's share, weakened by the way there and back; those nearer together than
//      a pulse is long are one return;
//   2. the air: the strongest drop, the strongest flake, and fog's own peak;
//   3. the strongest of all that are noticed, with the noise that their strength leaves;
//   4. CARLA's losses.
// What it keeps: nothing.
#include "render/ranging/lidar_shot.h"

#include <algorithm>
#include <cmath>

#include "world/external/sensor_attributes.h"

namespace reprise::render {

namespace {

/// Draws of a shot, so that none shares another's bits.
enum Draw : std::uint32_t { lost, weak_lost, first_range, first_drop = 16, first_flake = 128 };

constexpr double pulse_length = 1.5;  // [m] 10 ns there and back

struct Candidate {
    double range;
    double power;
    double intensity;
};

struct Candidates {
    std::array<Candidate, rays_of_wide_beam + 3> all;
    std::size_t count = 0;

    void add(const Candidate& one) { all[count++] = one; }
};

double left_of(const LidarOptics& optics, double range) {
    return optics.clear
               ? 1
               : static_cast<double>(fast_exp(static_cast<float>(-2 * optics.extinction * range)));
}

void add_surfaces(Candidates& candidates,
                  const LidarOptics& optics,
                  const Scene& scene,
                  std::span<const Echo> rays) {
    for (const Echo& echo : rays) {
        if (!echo || !(echo.distance > 0))
            continue;
        const double share = optics.has_reflectivity
                                 ? static_cast<double>(returned_share(
                                       reflectance_of(scene, echo), echo.cosine, optics.wetness))
                                 : 1;
        const double seen =
            share * left_of(optics, echo.distance) / static_cast<double>(rays.size());
        candidates.add({echo.distance, seen / (echo.distance * echo.distance), seen});
    }
    if (candidates.count < 2)
        return;
    // Of one pulse: the sum, at the mean place by power.
    const auto begin = candidates.all.begin();
    std::sort(
        begin,
        begin + static_cast<std::ptrdiff_t>(candidates.count),
        [](const Candidate& left, const Candidate& right) { return left.range < right.range; });
    std::size_t kept = 0;
    for (std::size_t i = 1; i < candidates.count; ++i) {
        const Candidate& next = candidates.all[i];
        Candidate& last = candidates.all[kept];
        if (next.range - last.range > pulse_length) {
            candidates.all[++kept] = next;
            continue;
        }
        const double power = last.power + next.power;
        last = {(last.range * last.power + next.range * next.power) / power,
                power,
                last.intensity + next.intensity};
    }
    candidates.count = kept + 1;
}

void add_air(Candidates& candidates,
             const LidarOptics& optics,
             double open,
             const world::SensorNoise& noise,
             std::uint64_t shot) {
    const auto add = [&](double range, double power) {
        candidates.add({range, power, power * range * range});
    };
    if (const auto drop = optics.rain.strongest(open, noise, shot, first_drop))
        add(drop->range, drop->power);
    if (const auto flake = optics.snow.strongest(open, noise, shot, first_flake))
        add(flake->range, flake->power);
    const FogReturn::Peak fog = optics.fog.before(open);
    if (fog.power > 0 && fog.range < optics.range)
        add(fog.range, fog.power);
}

/// CARLA's: of points that are not bright some get lost.
bool is_lost(const LidarOptics& optics,
             double brightness,
             const world::SensorNoise& noise,
             std::uint64_t shot,
             std::uint32_t number) {
    if (brightness > optics.dropoff_limit || !(optics.dropoff_zero > 0))
        return false;
    const double slope = optics.dropoff_limit > 0 ? optics.dropoff_zero / optics.dropoff_limit : 0;
    const double kept = slope * brightness + 1 - optics.dropoff_zero;
    return noise.uniform(shot, weak_lost + 3 * number) >= kept;
}

}  // namespace

LidarOptics::LidarOptics(const world::SensorSpec& spec, const world::Weather& weather)
    : range(world::attribute(spec, "range")),
      attenuation(world::attribute(spec, "atmosphere_attenuation_rate")),
      dropoff_general(world::attribute(spec, "dropoff_general_rate")),
      dropoff_limit(world::attribute(spec, "dropoff_intensity_limit")),
      dropoff_zero(world::attribute(spec, "dropoff_zero_intensity")),
      noise(world::attribute(spec, "noise_stddev")),
      accuracy(world::attribute(spec, "range_accuracy")),
      divergence(world::attribute(spec, "beam_divergence")),
      has_reflectivity(world::attribute(spec, "reflectivity") >= 0.5),
      returns(static_cast<std::size_t>(world::attribute(spec, "returns"))),
      wetness(0),
      // LISA's: 90 % are noticed just so at that distance.
      least_power(0.9 / (world::attribute(spec, "sensitivity_range") *
                         world::attribute(spec, "sensitivity_range"))),
      extinction(0),
      fog(0),
      rain({}, {}),
      snow({}, {}),
      clear(true) {
    if (world::attribute(spec, "weather") < 0.5)
        return;
    wetness = weather.wetness();
    const Hydrometeors drops = rain_drops(static_cast<double>(weather.rain()));
    const Hydrometeors flakes = snow_flakes(static_cast<double>(weather.snow()));
    // Dust is a fog of other grains.
    const double haze = static_cast<double>(weather.fog_extinction() + weather.dust());
    extinction = haze + drops.extinction + flakes.extinction;
    clear = !(extinction > 0);
    const Pulse pulse{divergence, least_power, extinction, range};
    fog = FogReturn(haze);
    rain = Precipitation(drops, pulse);
    snow = Precipitation(flakes, pulse);
}

LidarReturns returns_of(const LidarOptics& optics,
                        const Scene& scene,
                        std::span<const Echo> rays,
                        const world::SensorNoise& noise,
                        std::uint64_t shot) {
    Candidates candidates;
    add_surfaces(candidates, optics, scene, rays);
    if (!optics.clear) {
        const double open = rays.front() ? rays.front().distance : optics.range;
        add_air(candidates, optics, open, noise, shot);
    }
    const auto begin = candidates.all.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(candidates.count);
    std::sort(begin, end, [](const Candidate& left, const Candidate& right) {
        return left.power > right.power;
    });
    LidarReturns returns;
    for (auto one = begin; one != end && returns.count < optics.returns; ++one) {
        if (one->power < optics.least_power)
            break;
        const auto number = static_cast<std::uint32_t>(returns.count);
        const double bright =
            static_cast<double>(fast_exp(static_cast<float>(-optics.attenuation * one->range)));
        if (is_lost(optics, bright, noise, shot, number))
            continue;
        // LISA's: sigma = dR / sqrt(2 SNR).
        const double spread =
            std::sqrt(optics.noise * optics.noise +
                      optics.accuracy * optics.accuracy * optics.least_power / (2 * one->power));
        const double error = spread > 0 ? spread * noise.normal(shot, first_range + 3 * number) : 0;
        const double intensity = std::clamp(one->intensity * bright, 0.0, 1.0);
        returns.found[returns.count++] = {std::max(0.0, one->range + error),
                                          static_cast<float>(intensity)};
    }
    return returns;
}

}  // namespace reprise::render

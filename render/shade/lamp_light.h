#pragma once

#include "render/shade/source_grid.h"

namespace reprise::render {

/// What lamps and the moon would give a place if nothing stood between. Whether something does is
/// asked of one of them only, and seen from the mean of neighbours (Heitz, Hill and McGuire,
/// "Combining Analytic Direct Illumination and Stochastic Shadows", 2018): every second pixel asks
/// the strongest, the others one of the rest, chosen by how much it gives. Together they would
/// answer in sixteenths of all light, and what a lamp leaves dark would be spotted by its own
/// highlight.
struct LampLight {
    Color arriving = Color::Zero();  ///< over pi: what a white surface sends back
    Color shine = Color::Zero();     ///< mirrored towards the eye, radiance
    float strongest = 0.5F;          ///< share of `arriving` that the strongest source gives
    float strongest_shine = 0.5F;    ///< and of `shine`
};

/// Do the pixels with this place in the pattern of 4 x 4 ask the strongest source? They lie like a
/// chess board's white squares.
inline bool asks_strongest(int place) {
    return place < 8;
}

/// The light of one place, source by source.
class LampSum {
  public:
    /// `view`: unit vector from the eye to the place. `near` is moved there, and has to stay there.
    LampSum(const ShadingInput& input,
            NearSources& near,
            const Look& look,
            const Eigen::Vector3f& position,
            const Eigen::Vector3f& view);

    const LampLight& light() const { return light_; }

    bool any() const { return sum_ > 0; }

    /// Is the rest next to nothing? Then all pixels ask the strongest.
    bool is_one() const { return rest_ <= 0.01F * sum_; }

    /// Where the light comes from that a pixel with this place in the pattern asks; `spot` is on
    /// the unit disc, of the lamp's width. A vector to the source's place, or to beyond everything.
    Eigen::Vector3f towards(int place, const Eigen::Vector2f& spot) const;

  private:
    void add_four(std::size_t first, const Look& look, const Lanes3& position);
    void add_shine(std::size_t first, const Look& look, const Eigen::Vector3f& view);
    void add_moon(const Look& look);
    void find_strongest();
    void part();

    static constexpr float beyond = 3000;     // [m] where the moon's rays end
    static constexpr float moon_radius = 14;  // [m] there

    std::size_t one_of_rest(float place) const;

    bool is_moon(std::size_t i) const { return i >= near_.size(); }

    /// To the source's place, or to beyond everything.
    Eigen::Vector3f to_source(std::size_t i) const;

    /// Of each near source, to a multiple of four; behind them the moon.
    using Numbers = std::array<float, SourceGrid::most + 1>;

    LampLight light_;
    const NearSources& near_;
    const Moon& moon_;
    Eigen::Vector3f position_;
    std::size_t count_ = 0;  // of what gives nothing, too
    Lanes3 arriving_;        // of every fourth source
    float sum_ = 0;          // of what they give
    float rest_ = 0;         // without the strongest
    float shine_ = 0;        // luminance of all highlights
    std::size_t strongest_ = 0;
    alignas(16) Numbers factor_;  // on the intensity
    alignas(16) Numbers gives_;   // luminance
    Numbers shines_;              // luminance of the highlight; of wet ground only
};

/// The one that `place`, in [0, 1), falls to when all but the strongest share that range by what
/// they give.
inline std::size_t LampSum::one_of_rest(float place) const {
    float left = place * rest_;
    std::size_t chosen = strongest_;
    for (std::size_t i = 0; i < count_; ++i) {
        if (gives_[i] <= 0 || i == strongest_)
            continue;
        chosen = i;
        if (left < gives_[i])
            break;
        left -= gives_[i];
    }
    return chosen;
}

inline Eigen::Vector3f LampSum::to_source(std::size_t i) const {
    return is_moon(i) ? Eigen::Vector3f(moon_.to_moon * beyond)
                      : Eigen::Vector3f(near_.source(i).position - position_);
}

inline Eigen::Vector3f LampSum::towards(int place, const Eigen::Vector2f& spot) const {
    const std::size_t chosen = asks_strongest(place) || is_one()
                                   ? strongest_
                                   : one_of_rest((static_cast<float>(place & 7) + 0.5F) / 8);
    const Eigen::Vector3f way = to_source(chosen);
    const Eigen::Vector3f across = way.unitOrthogonal();
    const Eigen::Vector3f up = across.cross(way).normalized();
    const float radius = is_moon(chosen) ? moon_radius : near_.source(chosen).radius;
    return way + radius * (spot.x() * across + spot.y() * up);
}

}  // namespace reprise::render

#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>
#include <vector>

#include "render/look/look.h"
#include "render/scene/tracer.h"
#include "render/shade/light.h"

namespace reprise::render {

/// A pixel's surface, in two parts: what it is like, and the light that was found there.
struct Sample {
    Look look;
    Light light;  ///< filtered
};

/// `place` becomes what `make()` says, which is made where it stays: who copies numbers together
/// that were just written one by one waits until they have arrived in memory.
template <typename Made, typename Make>
void make_in(Made& place, const Make& make) {
    static_assert(std::is_trivially_destructible_v<Made>);
    ::new (static_cast<void*>(&place)) Made(make());
}

/// What the filter between neighbouring pixels looks at, beside which triangle was hit: 64 bytes.
struct alignas(64) RawLight {
    Eigen::Vector3f position;  ///< scene
    float tolerance = 0;       ///< [m] off the plane that still counts as the same surface
    Eigen::Vector3f flat;      ///< the triangle's normal
    Light light;
};

/// What is known of a tile's pixels while it is shaded: of each 170 bytes. By rows.
struct TilePixels {
    static constexpr std::size_t count = std::size_t{tile} * tile;

    std::array<RawLight, count> lights;
    std::array<Sample, count> samples;
    std::array<LampLight, count> lamps;  ///< by night only
};

/// Memory for tiles: what one is done with the next one gets. A picture of 800x600 needs a tenth of
/// its 80 MB at a time, and finds that in the cache. From any thread.
class TilePool {
  public:
    /// Holds what an earlier tile left.
    TilePixels* take() {
        const std::lock_guard hold(lock_);
        if (free_.empty()) {
            all_.push_back(std::make_unique<TilePixels>());
            return all_.back().get();
        }
        TilePixels* pixels = free_.back();
        free_.pop_back();
        return pixels;
    }

    void give_back(TilePixels* pixels) {
        const std::lock_guard hold(lock_);
        free_.push_back(pixels);
    }

    /// Takes all of them: a picture that was broken off gave nothing back.
    void recall() {
        free_.clear();
        for (const auto& pixels : all_)
            free_.push_back(pixels.get());
    }

    /// How many there are.
    std::size_t size() const { return all_.size(); }

  private:
    std::mutex lock_;
    std::vector<std::unique_ptr<TilePixels>> all_;
    std::vector<TilePixels*> free_;  // the last one is the warmest
};

}  // namespace reprise::render

#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "render/shade/frame.h"
#include "render/trace/prefetch.h"

namespace reprise::render {

/// A right-handed frame around a unit vector z; x and y are any.
struct OrthonormalBasis {
    explicit OrthonormalBasis(const Eigen::Vector3f& z_axis)
        : x(z_axis.unitOrthogonal()),
          y(z_axis.cross(x)),
          z(z_axis) {}

    Eigen::Vector3f apply(const Eigen::Vector3f& v) const {
        return v.x() * x + v.y() * y + v.z() * z;
    }

    Eigen::Vector3f x, y, z;
};

inline constexpr int block = 8;  ///< pixels of a tile that lie together, see tile_pixel

/// Everything that the stages of shade() share.
struct ShadingJob {
    const ShadingInput& input;
    const Camera& camera;
    std::uint32_t mask;
    const std::vector<Hit>& hits;
    Frame& frame;
    std::vector<TilePixels*> tiles;  ///< by rows; those that are being shaded
    SourceGrid sources;
    bool lamps_matter;  ///< is there a lamp, or a moon?
    Eigen::Vector3f eye;
    float pixel;
    std::array<Eigen::Vector3f, 16> to_sun;  ///< to places on its disc
    bool sun_matters;

    /// Is the pixel in the picture? Tiles at its right and lower edge reach beyond it.
    bool contains(const Eigen::Vector2i& at) const {
        return at.x() < camera.width() && at.y() < camera.height();
    }

    /// Calls `fetch(index in the frame)` for the i-th pixel of a tile, if there is one: who comes
    /// to the next one would wait for memory.
    template <typename Fetch>
    void look_ahead(const Eigen::Vector2i& corner, int i, const Fetch& fetch) const {
        const Eigen::Vector2i there = corner + tile_pixel(i);
        if (i < tile * tile && contains(there))
            fetch(frame.index(there.x(), there.y()));
    }

    int columns() const { return (camera.width() + tile - 1) / tile; }  ///< of tiles

    /// Of the tile at `corner`.
    TilePixels*& pixels(const Eigen::Vector2i& corner) {
        return tiles[static_cast<std::size_t>(corner.y() / tile * columns() + corner.x() / tile)];
    }
};

/// Where in its tile a pixel's numbers are.
inline std::size_t tile_place(int x, int y) {
    constexpr unsigned side = tile;
    return static_cast<unsigned>(y) % side * side + static_cast<unsigned>(x) % side;
}

/// A tile that is being shaded and those around it.
class TileBlock {
  public:
    TileBlock(ShadingJob& job, const Eigen::Vector2i& corner)
        : left_(corner.x() - tile),
          top_(corner.y() - tile) {
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x) {
                const Eigen::Vector2i there(left_ + x * tile, top_ + y * tile);
                const bool inside = there.minCoeff() >= 0 && job.contains(there);
                tiles_[static_cast<std::size_t>(y * 3 + x)] = inside ? job.pixels(there) : nullptr;
            }
    }

    /// Of the pixel's tile: the pixel is of the picture, and within a tile's side.
    TilePixels& pixels(int x, int y) const {
        constexpr unsigned side = tile;
        return *tiles_[static_cast<unsigned>(y - top_) / side * 3 +
                       static_cast<unsigned>(x - left_) / side];
    }

    TilePixels& middle() const { return *tiles_[4]; }

  private:
    int left_;
    int top_;
    std::array<TilePixels*, 9> tiles_;
};

/// Runs `work(upper left pixel)` for each tile, in parallel.
void for_tiles(const Camera& camera,
               const std::function<void(const Eigen::Vector2i& corner)>& work);

/// Knows which tiles have finished a stage, so that the next one can follow tile by tile.
class TileStage {
  public:
    explicit TileStage(const Camera& camera);

    std::size_t tiles() const { return waited_for_.size(); }

    /// Says that the tile at `corner` is finished; calls `next(corner)` for each tile of which it
    /// was the last one among itself and its eight neighbours. From any thread.
    template <typename Next>
    void finish(const Eigen::Vector2i& corner, const Next& next) {
        const int column = corner.x() / tile;
        const int row = corner.y() / tile;
        for (int y = std::max(0, row - 1); y <= std::min(rows_ - 1, row + 1); ++y)
            for (int x = std::max(0, column - 1); x <= std::min(columns_ - 1, column + 1); ++x)
                if (--waited_for_[static_cast<std::size_t>(y * columns_ + x)] == 0)
                    next({x * tile, y * tile});
    }

  private:
    int columns_;
    int rows_;
    std::vector<std::atomic<int>> waited_for_;
};

inline constexpr float infinite = std::numeric_limits<float>::infinity();

/// Rays that are traced together; `owners` says which pixel or sample each result belongs to.
class RayBatch {
  public:
    static constexpr std::size_t most = 2 * tile * tile;

    void clear() { count_ = 0; }

    std::size_t size() const { return count_; }

    std::span<const Ray> rays() const { return std::span(rays_).first(count_); }

    std::size_t owner(std::size_t i) const { return owners_[i]; }

    /// Number by number into its place: whoever copies a ray that was just made waits until its
    /// numbers have arrived in memory, which cost a twentieth of a picture.
    void add(const Eigen::Vector3f& origin,
             const Eigen::Vector3f& direction,
             float far,
             std::uint32_t mask,
             std::size_t owner) {
        Ray& ray = rays_[count_];
        ray.origin = origin;
        ray.direction = direction;
        ray.far = far;
        ray.mask = mask;
        owners_[count_++] = owner;
    }

  private:
    std::size_t count_ = 0;
    std::array<Ray, most> rays_;
    std::array<std::size_t, most> owners_;
};

/// Secondary rays of a tile by their kind, and memory for what they find.
struct TileRays {
    RayBatch sun, sky, lamp, mirror;
    std::array<std::uint8_t, RayBatch::most> visible;
    std::array<Hit, RayBatch::most> hits;

    void clear() {
        for (RayBatch* batch : {&sun, &sky, &lamp, &mirror})
            batch->clear();
    }
};

/// Traces visibility rays and calls `store(owner, visible)` for each.
template <typename Store>
void trace_batch(const ShadingJob& job,
                 TileRays& rays,
                 const RayBatch& batch,
                 bool coherent,
                 const Store& store) {
    trace_visibility(
        job.input.scene, batch.rays(), coherent, std::span(rays.visible).first(batch.size()));
    for (std::size_t i = 0; i < batch.size(); ++i)
        store(batch.owner(i), rays.visible[i] != 0);
}

/// A point on the unit disc, and a direction of the half sphere around z, closer to z more often.
/// The first 16 are the pattern that 4 x 4 neighbouring pixels share among them; 32 in all.
const Eigen::Vector2f& disc_point(int place);
const Eigen::Vector3f& sky_direction(int place);

/// The origin of secondary rays: a little off the surface, so that they do not hit it again.
inline Eigen::Vector3f offset_origin(const Eigen::Vector3f& position,
                                     const Eigen::Vector3f& flat,
                                     float distance) {
    return position + flat * (2e-3F + 1e-4F * distance);
}

/// To places on the sun's disc: made once, as who has just made one waits until it has arrived in
/// memory.
std::array<Eigen::Vector3f, 16> sun_directions(const Sky& sky);

inline const Eigen::Vector3f& sun_direction(const ShadingJob& job, int place) {
    return job.to_sun[static_cast<std::size_t>(place)];
}

/// To one of the lamps that light a place, or to the moon: from there to its middle.
inline Eigen::Vector3f lamp_direction(const LampSum& lamps, int place) {
    return lamps.towards(place, disc_point((place * 5 + 3) & (lamps.is_one() ? 15 : 7)));
}

/// How much of a way to a lamp [m] is free of the lamp's own housing.
inline float lamp_reach(const Eigen::Vector3f& way) {
    return 1 - std::min(0.2F / way.norm(), 0.9F);
}

/// How bright a colour looks, in [0, 1): steps of it show as edges.
inline float tone_of(const Color& color) {
    const float light = luminance(color);
    return light / (light + 0.5F);
}

/// Radiance of the sky behind a pixel.
Color sky_color(const ShadingJob& job, const Eigen::Vector3f& direction);

// The stages, for the tile at `corner`.
void light_tile(ShadingJob& job, const Eigen::Vector2i& corner);
void combine_tile(ShadingJob& job, const Eigen::Vector2i& corner);
void refine_tile(ShadingJob& job, const Eigen::Vector2i& corner);

}  // namespace reprise::render

// Detour and Recast compute in single precision with nothing of the mathematics library but square
// roots, which are exact everywhere; ways are the same on every machine.
#include "walkers/map/walk_map.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>
#include <future>
#include <system_error>
#include <thread>

#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshQuery.h>

#include "walkers/map/owned.h"
#include "walkers/map/walk_tiles.h"
#include "world/check.h"

namespace reprise::walkers {

namespace {

constexpr int most_polygons = 4096;  ///< of a way
constexpr int reference_bits = 22;   ///< of a Detour reference: for the tile and its polygon
constexpr int most_nodes = 65535;    ///< looked at for one way: Detour's limit

using Point = std::array<float, 3>;

ground::Surface surface_of(unsigned char area) {
    if (area == walk_sidewalk)
        return ground::Surface::sidewalk;
    return area == walk_crossing ? ground::Surface::crossing : ground::Surface::road;
}

unsigned char area_on(ground::Surface surface) {
    if (surface == ground::Surface::sidewalk)
        return walk_sidewalk;
    return surface == ground::Surface::crossing ? walk_crossing : walk_road;
}

/// Row by row. Tiles do not know of each other: as many at a time as the machine has cores.
std::vector<WalkTile> build_all(const WalkTiles& source) {
    constexpr unsigned most_workers = 8;
    const auto columns = static_cast<std::size_t>(source.columns());
    std::vector<WalkTile> tiles(columns * static_cast<std::size_t>(source.rows()));
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < tiles.size(); i = next++)
            tiles[i] = source.build(static_cast<int>(i % columns), static_cast<int>(i / columns));
    };
    std::vector<std::future<void>> helpers;
    const unsigned workers = std::min(std::thread::hardware_concurrency(), most_workers);
    try {
        while (helpers.size() + 1 < std::min<std::size_t>(workers, tiles.size()))
            helpers.push_back(std::async(std::launch::async, work));
    } catch (const std::system_error&) {  // no more threads for us: fewer do it as well
    }
    work();
    for (std::future<void>& helper : helpers)
        helper.get();
    return tiles;
}

/// How many tiles there are where somebody can walk, and polygons in the fullest of them.
struct Extent {
    std::size_t tiles = 0;
    std::size_t polygons = 0;

    explicit Extent(const std::vector<WalkTile>& all) {
        for (const WalkTile& tile : all) {
            tiles += tile.bytes.empty() ? 0 : 1;
            polygons = std::max(polygons, tile.polygons);
        }
    }

    bool fits_references() const {
        const auto bits = [](std::size_t n) { return std::bit_width(std::bit_ceil(n)) - 1; };
        return bits(tiles) + bits(polygons) <= reference_bits;
    }
};

}  // namespace

struct WalkMap::Mesh {
    Owned<dtNavMesh, dtFreeNavMesh> tiles{dtAllocNavMesh()};
    Owned<dtNavMeshQuery, dtFreeNavMeshQuery> query{dtAllocNavMeshQuery()};
    dtQueryFilter filter;
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    world::Hasher hasher;
    std::size_t polygons = 0;
    std::size_t bytes = 0;

    void start(const WalkTiles& source, const Extent& extent);
    void add(const WalkTile& tile);

    /// The polygon at a place, and the place on it; 0: none within reach.
    dtPolyRef find(const Eigen::Vector3d& p_world, Point& nearest) const;
    std::vector<Step> corners(const std::vector<dtPolyRef>& polygons_on_the_way,
                              const Point& from,
                              const Point& to) const;
};

void WalkMap::Mesh::start(const WalkTiles& source, const Extent& extent) {
    origin = source.origin();
    dtNavMeshParams params{};
    params.tileWidth = params.tileHeight = static_cast<float>(source.edge());
    params.maxTiles = std::max(1, static_cast<int>(extent.tiles));
    params.maxPolys = std::max(1, static_cast<int>(extent.polygons));
    REPRISE_CHECK(dtStatusSucceed(tiles->init(&params)), "walk map: too many tiles");
    REPRISE_CHECK(dtStatusSucceed(query->init(tiles.get(), most_nodes)), "walk map: query");
}

void WalkMap::Mesh::add(const WalkTile& tile) {
    if (tile.bytes.empty())
        return;
    hasher.add_bytes(tile.bytes.data(), tile.bytes.size());
    polygons += tile.polygons;
    bytes += tile.bytes.size();
    // Detour owns its copy, and frees it with its own function.
    auto* data = static_cast<unsigned char*>(dtAlloc(tile.bytes.size(), DT_ALLOC_PERM));
    REPRISE_CHECK(data != nullptr, "walk map: no memory");
    std::memcpy(data, tile.bytes.data(), tile.bytes.size());
    const dtStatus status =
        tiles->addTile(data, static_cast<int>(tile.bytes.size()), DT_TILE_FREE_DATA, 0, nullptr);
    REPRISE_CHECK(dtStatusSucceed(status), "walk map: tile refused");
}

dtPolyRef WalkMap::Mesh::find(const Eigen::Vector3d& p_world, Point& nearest) const {
    constexpr float reach[] = {2, 2, 2};  // [m]
    dtPolyRef polygon = 0;
    const Point p = to_recast(p_world, origin);
    query->findNearestPoly(p.data(), reach, &filter, &polygon, nearest.data());
    return polygon;
}

std::vector<WalkMap::Step> WalkMap::Mesh::corners(const std::vector<dtPolyRef>& polygons_on_the_way,
                                                  const Point& from,
                                                  const Point& to) const {
    std::vector<Point> points(most_polygons);
    std::vector<unsigned char> flags(most_polygons);
    std::vector<dtPolyRef> references(most_polygons);
    int count = 0;
    query->findStraightPath(from.data(),
                            to.data(),
                            polygons_on_the_way.data(),
                            static_cast<int>(polygons_on_the_way.size()),
                            points[0].data(),
                            flags.data(),
                            references.data(),
                            &count,
                            most_polygons,
                            DT_STRAIGHTPATH_AREA_CROSSINGS);
    std::vector<Step> steps;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        unsigned char area = walk_sidewalk;
        // The last corner leads nowhere and has no polygon: it keeps the surface of the one before.
        if (references[i] != 0)
            tiles->getPolyArea(references[i], &area);
        const ground::Surface surface =
            references[i] == 0 && !steps.empty() ? steps.back().surface : surface_of(area);
        steps.push_back({from_recast(points[i].data(), origin), surface});
    }
    return steps;
}

WalkMap::WalkMap(const ground::GroundMesh& ground,
                 const TileRules& rules,
                 std::span<const world::Obstacle> obstacles,
                 std::span<const world::Loop> crossings)
    : mesh_(std::make_unique<Mesh>()) {
    // Small tiles first: Recast joins the triangles of an outline in the third power of their
    // number.
    for (WalkTiles source(ground, rules, obstacles, crossings); source.columns() > 0;) {
        const std::vector<WalkTile> tiles = build_all(source);
        const Extent extent(tiles);
        if (extent.fits_references()) {
            mesh_->start(source, extent);
            for (const WalkTile& tile : tiles)
                mesh_->add(tile);
            return;
        }
        source = WalkTiles(ground, rules, obstacles, crossings, source.edge_in_cells() * 3 / 2);
    }
}

WalkMap::~WalkMap() = default;
WalkMap::WalkMap(WalkMap&&) noexcept = default;
WalkMap& WalkMap::operator=(WalkMap&&) noexcept = default;

std::optional<std::vector<WalkMap::Step>> WalkMap::path(const Eigen::Vector3d& from_world,
                                                        const Eigen::Vector3d& to_world) const {
    const std::optional<Place> from = nearest(from_world);
    const std::optional<Place> to = nearest(to_world);
    if (!from || !to)
        return std::nullopt;
    return path(*from, *to);
}

std::optional<std::vector<WalkMap::Step>> WalkMap::path(const Place& from, const Place& to) const {
    return path(from, to, Costs{});
}

std::optional<std::vector<WalkMap::Step>> WalkMap::path(const Place& from,
                                                        const Place& to,
                                                        const Costs& costs) const {
    dtQueryFilter filter;
    filter.setAreaCost(walk_road, static_cast<float>(costs.road));
    filter.setAreaCost(walk_crossing, static_cast<float>(costs.crossing));
    filter.setAreaCost(walk_sidewalk, 1);
    const Point start = to_recast(from.position, mesh_->origin);
    const Point end = to_recast(to.position, mesh_->origin);
    std::vector<dtPolyRef> way(most_polygons);
    int count = 0;
    mesh_->query->findPath(from.polygon,
                           to.polygon,
                           start.data(),
                           end.data(),
                           &filter,
                           way.data(),
                           &count,
                           most_polygons);
    // Without a way Detour gives the way to the nearest place.
    if (count == 0 || way[static_cast<std::size_t>(count) - 1] != to.polygon)
        return std::nullopt;
    way.resize(static_cast<std::size_t>(count));
    return mesh_->corners(way, start, end);
}

std::optional<WalkMap::Place> WalkMap::nearest(const Eigen::Vector3d& p_world) const {
    if (mesh_->polygons == 0)
        return std::nullopt;
    Point found{};
    const dtPolyRef polygon = mesh_->find(p_world, found);
    if (polygon == 0)
        return std::nullopt;
    return Place{polygon, from_recast(found.data(), mesh_->origin)};
}

WalkMap::Place WalkMap::slide(const Place& from, const Eigen::Vector3d& p_world) const {
    constexpr int most_passed = 16;  // polygons
    const Point start = to_recast(from.position, mesh_->origin);
    const Point end = to_recast(p_world, mesh_->origin);
    Point found = start;
    std::array<dtPolyRef, most_passed> passed{};
    int count = 0;
    const dtStatus status = mesh_->query->moveAlongSurface(from.polygon,
                                                           start.data(),
                                                           end.data(),
                                                           &mesh_->filter,
                                                           found.data(),
                                                           passed.data(),
                                                           &count,
                                                           most_passed);
    if (dtStatusFailed(status) || count == 0)
        return from;
    return {passed[static_cast<std::size_t>(count) - 1], from_recast(found.data(), mesh_->origin)};
}

bool WalkMap::is_clear(const Place& from,
                       const Eigen::Vector3d& p_world,
                       ground::Surface most) const {
    constexpr int most_passed = 64;    // polygons
    constexpr float very_end = 0.99F;  // of the way: corners lie on the mesh's edge
    const Point start = to_recast(from.position, mesh_->origin);
    const Point end = to_recast(p_world, mesh_->origin);
    std::array<dtPolyRef, most_passed> passed{};
    float share = 0;
    Point normal{};
    int count = 0;
    mesh_->query->raycast(from.polygon,
                          start.data(),
                          end.data(),
                          &mesh_->filter,
                          &share,
                          normal.data(),
                          passed.data(),
                          &count,
                          most_passed);
    if (share <= very_end)
        return false;
    const unsigned char least_area = area_on(most);
    const auto end_of_passed = passed.begin() + count;
    return std::all_of(passed.begin(), end_of_passed, [&](dtPolyRef polygon) {
        unsigned char area = walk_sidewalk;
        mesh_->tiles->getPolyArea(polygon, &area);
        return area >= least_area;
    });
}

ground::Surface WalkMap::surface(const Place& place) const {
    unsigned char area = walk_sidewalk;
    mesh_->tiles->getPolyArea(place.polygon, &area);
    return surface_of(area);
}

std::size_t WalkMap::polygons() const {
    return mesh_->polygons;
}

std::size_t WalkMap::bytes() const {
    return mesh_->bytes;
}

world::Digest128 WalkMap::digest() const {
    return mesh_->hasher.digest128();
}

}  // namespace reprise::walkers

#include "render/shapes/people/body.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/shapes/people/head.h"
#include "world/check.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::Clothing;

/// A slice across the trunk. [m]
struct Slice {
    double z;
    double half_width;
    double half_depth;
    double ahead;
    Material material;  ///< of what lies above it
};

std::vector<Vector3f> ring_of(const Slice& slice) {
    constexpr int sides = 20;
    std::vector<Vector3f> ring;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        // Between an ellipse and a box.
        const auto fuller = [](double x) { return std::copysign(std::pow(std::abs(x), 0.85), x); };
        ring.emplace_back(
            static_cast<float>(slice.ahead + slice.half_depth * fuller(std::cos(angle))),
            static_cast<float>(slice.half_width * fuller(std::sin(angle))),
            static_cast<float>(slice.z));
    }
    return ring;
}

/// Neighbours of one material share their vertices, so that they are shaded smoothly.
void add_slices(Mesh& mesh, const std::vector<Slice>& slices) {
    std::size_t first = 0;
    while (first + 1 < slices.size()) {
        std::size_t last = first + 1;
        while (last + 1 < slices.size() && slices[last].material == slices[first].material)
            ++last;
        std::vector<std::vector<Vector3f>> rings;
        for (std::size_t i = first; i <= last; ++i)
            rings.push_back(ring_of(slices[i]));
        if (last + 1 == slices.size()) {
            const Slice& top = slices[last];
            rings.push_back(ring_of({top.z, 0, 0, top.ahead, top.material}));
        }
        if (first == 0) {
            const Slice& low = slices[first];
            rings.insert(rings.begin(), ring_of({low.z, 0, 0, low.ahead, low.material}));
        }
        add_loft(mesh, rings, true, {slices[first].material});
        first = last;
    }
}

bool is_one_piece(Clothing clothing) {
    return clothing == Clothing::dress || clothing == Clothing::gown || clothing == Clothing::coat;
}

void add_torso(Mesh& mesh, const world::WalkerModel& model, const BodyProportions& body) {
    const double h = model.height;
    const double t = body.trunk;
    const double waist = model.girth / (2 * std::numbers::pi);
    const double hips = std::max(0.094 * h, 1.12 * waist);
    const double chest = 0.385 * model.shoulder_width;
    const double depth = std::max(0.062 * h, 0.80 * waist);
    const double belly = std::max(0.0, waist - 0.082 * h) * 0.6;
    const Material low = is_one_piece(model.clothing) ? Material::shirt : Material::trousers;
    const bool belted = model.clothing == Clothing::uniform || model.clothing == Clothing::workwear;
    const Material middle = belted ? Material::trim : Material::shirt;
    const Material upper = model.clothing == Clothing::workwear ? Material::trim : Material::shirt;
    const double seam = 0.20 * t;
    std::vector<Slice> slices{
        {-0.115 * h, 0.45 * hips, 0.45 * hips, 0, low},
        {-0.085 * h, 0.92 * hips, 0.78 * hips, 0, low},
        {-0.02 * h, hips, 0.82 * hips, -0.004 * h, low},
        {seam, 1.01 * hips, 0.80 * hips, 0.2 * belly, middle},
        {std::max(0.27 * t, seam + 0.01),
         0.98 * std::max(hips * 0.94, waist * 1.13),
         waist * .92,
         belly,
         upper},
        {0.42 * t, 1.12 * waist, 0.90 * waist, belly, upper},
        {0.62 * t, 0.5 * (1.12 * waist + chest), 0.5 * (0.9 * waist + depth), 0.4 * belly, upper},
        {0.80 * t, chest, depth, 0.006 * h, upper},
        {0.92 * t, 1.06 * chest, 0.92 * depth, 0, Material::shirt},
        {1.02 * t, 0.98 * chest, 0.66 * depth, -0.006 * h, Material::shirt},
        {1.07 * t, 0.060 * h, 0.048 * h, -0.004 * h, Material::skin},
        {1.11 * t, 0.037 * h, 0.037 * h, 0, Material::skin},
        {1.11 * t + 0.05 * h, 0.036 * h, 0.037 * h, 0.008 * h, Material::skin}};
    add_slices(mesh, slices);
    if (model.clothing == Clothing::suit) {
        // The shirt in the jacket's opening, and the tie on it.
        const auto front = static_cast<float>(0.93 * depth);
        const auto collar = static_cast<float>(0.97 * t);
        const auto button = static_cast<float>(0.62 * t);
        add_tube(mesh,
                 {{front, 0, button}, {front * 0.72F, 0, collar}, .006F, .062F, 12},
                 {Material::headgear});
        add_tube(mesh,
                 {{front + .012F, 0, button + .03F},
                  {front * 0.72F + .058F, 0, collar},
                  .019F,
                  .012F,
                  8},
                 {Material::trim});
    }
}

/// How much wider a hem is below than at the hips, across and ahead: the longer, the more room a
/// step takes.
std::pair<double, double> flare_of(Clothing clothing) {
    switch (clothing) {
        case Clothing::suit:
            return {1.10, 1.0};
        case Clothing::coat:
            return {1.22, 1.25};
        case Clothing::gown:
            return {1.45, 2.1};
        default:
            return {1.45, 1.40};
    }
}

/// Wide enough for hips and thighs that stand: strides stretch it, see figure().
std::vector<Slice> hem_slices(const world::WalkerModel& model) {
    const double length = hem_length(model);
    if (length == 0)
        return {};
    const BodyProportions body(model);
    const double h = model.height;
    const double waist = model.girth / (2 * std::numbers::pi);
    const double hips = std::max(0.094 * h, 1.12 * waist);
    const double legs = body.half_hip + thigh_radius(body);
    const double wide = std::max(hips, 1.02 * legs);
    const double bent = model.age == world::Age::senior ? 0.018 * h : 0;  // the trunk, see stoop
    const auto [flare, fall] = flare_of(model.clothing);
    const Material cloth = model.clothing == Clothing::skirt ? Material::trousers : Material::shirt;
    return {{-length, .9 * flare * wide, .9 * fall * hips, 0, cloth},
            {-length + 0.004, flare * wide, fall * hips, 0, cloth},
            {-0.5 * length,
             std::lerp(1, flare, 0.55) * wide,
             std::lerp(.9, fall, .5) * hips + bent,
             0,
             cloth},
            {std::max(-0.03 * h, -0.4 * length), 1.06 * wide, 0.90 * hips + bent, -0.004, cloth},
            {0.10 * body.trunk, 1.03 * hips, 0.84 * hips, 0, cloth},
            // Ends inside of the trunk, also when strides stretch it.
            {0.22 * body.trunk, 0.62 * hips, 0.50 * hips, 0, cloth}};
}

}  // namespace

Mesh trunk_mesh(const world::WalkerModel& model) {
    Mesh mesh;
    const BodyProportions body(model);
    add_torso(mesh, model, body);
    add_head(mesh, model, body);
    drop_degenerate(mesh);
    smooth(mesh, 1.2);
    return mesh;
}

double hem_length(const world::WalkerModel& model) {
    switch (model.clothing) {
        case Clothing::skirt:
            return model.age == world::Age::senior ? 0.30 * model.height : 0.22 * model.height;
        case Clothing::dress:
            return 0.26 * model.height;
        case Clothing::coat:
            return 0.22 * model.height;
        case Clothing::gown:
            return 0.47 * model.height;
        case Clothing::suit:
            return 0.075 * model.height;
        default:
            return 0;
    }
}

Mesh hem_mesh(const world::WalkerModel& model) {
    Mesh mesh;
    add_slices(mesh, hem_slices(model));
    drop_degenerate(mesh);
    smooth(mesh, 1.2);
    return mesh;
}

Hem::Hem(const world::WalkerModel& model) {
    for (const Slice& slice : hem_slices(model)) {
        heights_.push_back(slice.z);
        sizes_.push_back({slice.half_width, slice.half_depth});
    }
    REPRISE_CHECK(!heights_.empty(), model.name);
}

HemSize Hem::at(double z) const {
    std::size_t above = 1;
    while (above + 1 < heights_.size() && heights_[above] < z)
        ++above;
    const HemSize& low = sizes_[above - 1];
    const HemSize& high = sizes_[above];
    const double share =
        std::clamp((z - heights_[above - 1]) / (heights_[above] - heights_[above - 1]), 0.0, 1.0);
    return {std::lerp(low.width, high.width, share), std::lerp(low.depth, high.depth, share)};
}

Mesh shoe_mesh() {
    // x behind the tip, half width, height: seen from above a sole, from the side a shoe.
    struct Station {
        float x, half, high;
    };

    Mesh mesh;
    std::vector<std::vector<Vector3f>> rings;
    for (const Station& s : {Station{-1.30F, .13F, .30F},
                             Station{-1.24F, .22F, .42F},
                             Station{-1.00F, .25F, .52F},
                             Station{-.78F, .26F, .44F},
                             Station{-.45F, .33F, .32F},
                             Station{-.12F, .31F, .26F},
                             Station{.06F, .20F, .18F},
                             Station{.10F, .08F, .12F}}) {
        const float low = s.x > -.12F ? 0.02F + 0.3F * (s.x + .12F) : 0.02F;
        rings.push_back({{s.x, s.half * .9F, low},
                         {s.x, s.half, low + .10F},
                         {s.x, s.half * .75F, s.high * .85F},
                         {s.x, 0, s.high},
                         {s.x, -s.half * .75F, s.high * .85F},
                         {s.x, -s.half, low + .10F},
                         {s.x, -s.half * .9F, low}});
    }
    rings.insert(rings.begin(), std::vector<Vector3f>(7, Vector3f(-1.31F, 0, .15F)));
    rings.push_back(std::vector<Vector3f>(7, Vector3f(.11F, 0, .10F)));
    add_loft(mesh, rings, true, {Material::of_instance});
    drop_degenerate(mesh);
    smooth(mesh, 1.2);
    return mesh;
}

Mesh ball_mesh() {
    Mesh mesh;
    add_ellipsoid(
        mesh, Eigen::Vector3f::Zero(), Eigen::Vector3f::Ones(), 16, {Material::of_instance});
    drop_degenerate(mesh);
    smooth(mesh, 3);
    return mesh;
}

Mesh bone_mesh() {
    // Rings from pole to pole; the ends bulge by a third of the radius, as seen after stretching.
    Mesh mesh;
    std::vector<std::vector<Eigen::Vector3f>> rings;
    const std::vector<Eigen::Vector2d> outline{{0, -.10},
                                               {.6, -.075},
                                               {.9, -.03},
                                               {1, .05},
                                               {1.02, .25},
                                               {.90, .6},
                                               {.76, .9},
                                               {.72, 1.0},
                                               {.5, 1.05},
                                               {0, 1.08}};
    for (const Eigen::Vector2d& point : outline) {
        std::vector<Eigen::Vector3f>& ring = rings.emplace_back();
        for (int i = 0; i < 12; ++i) {
            const double angle = 2 * std::numbers::pi * i / 12;
            ring.emplace_back(static_cast<float>(point.x() * std::cos(angle)),
                              static_cast<float>(point.x() * std::sin(angle)),
                              static_cast<float>(point.y()));
        }
    }
    add_loft(mesh, rings, true, {Material::of_instance});
    drop_degenerate(mesh);
    smooth(mesh, 3);
    return mesh;
}

}  // namespace reprise::render

#include <algorithm>
#include <cmath>

#include "render/shapes/builder.h"
#include "render/shapes/fast_math.h"
#include "render/shapes/street/prop_mesh.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::PropKind;

/// Adds to one prop; its parts' finishes.
struct Maker {
    Builder build;
    PropKind kind;
    float x;  ///< half of the length
    float y;  ///< half of the width
    float height;

    Finish of(PropFinish finish) const { return {Material::prop, PropTag{kind, finish}.bits()}; }
};

/// Drawn facing -y, and turned about: who sits on it looks to its left.
void add_bench(Maker& m) {
    const Finish timber = m.of(PropFinish::timber);
    const Finish iron = m.of(PropFinish::iron);
    for (const float side : {-.75F, .75F}) {
        const float x = side * m.x;
        m.build.box({x - .03F, -m.y + .05F, -.05F}, {x + .03F, -m.y + .11F, .44F}, iron);
        m.build.box({x - .03F, m.y - .14F, -.05F}, {x + .03F, m.y - .08F, m.height}, iron);
        m.build.box({x - .03F, -m.y + .05F, .38F}, {x + .03F, m.y - .1F, .42F}, iron);
        m.build.box({x - .03F, -m.y + .05F, .62F}, {x + .03F, m.y - .1F, .66F}, iron);
    }
    for (int i = 0; i < 4; ++i) {
        const float y = mix(-m.y + .03F, m.y - .24F, static_cast<float>(i) / 3);
        m.build.box({-m.x, y, .42F}, {m.x, y + .10F, .46F}, timber);
    }
    for (int i = 0; i < 3; ++i) {
        const float z = .54F + .12F * static_cast<float>(i);
        m.build.box({-m.x, m.y - .17F, z}, {m.x, m.y - .14F, z + .09F}, timber);
    }
}

/// A shelter, drawn open to -y as the bench, with a bench and a post with the stop's sign.
void add_bus_stop(Maker& m) {
    const Finish steel = m.of(PropFinish::iron);
    const Finish glass = m.of(PropFinish::glass);
    for (const float x : {-m.x + .05F, m.x - .05F})
        for (const float y : {-m.y + .3F, m.y - .05F})
            m.build.box(
                {x - .035F, y - .035F, -.05F}, {x + .035F, y + .035F, m.height - .1F}, steel);
    m.build.box({-m.x - .1F, -m.y, m.height - .12F}, {m.x + .1F, m.y + .05F, m.height}, steel);
    const float panes = std::max(1.0F, std::round(2 * m.x / 1.3F));
    for (int i = 0; i < static_cast<int>(panes); ++i) {
        const float left = mix(-m.x + .1F, m.x - .1F, static_cast<float>(i) / panes);
        const float right = mix(-m.x + .1F, m.x - .1F, static_cast<float>(i + 1) / panes);
        m.build.box(
            {left + .02F, m.y - .06F, .2F}, {right - .02F, m.y - .045F, m.height - .25F}, glass);
        m.build.box(
            {left - .015F, m.y - .075F, .15F}, {left + .015F, m.y - .03F, m.height - .12F}, steel);
    }
    // One end is glass, the other carries a poster.
    m.build.box({-m.x + .04F, -m.y + .36F, .2F}, {-m.x + .055F, m.y - .1F, m.height - .25F}, glass);
    m.build.box(
        {m.x - .1F, -m.y + .36F, .35F}, {m.x, m.y - .1F, m.height - .4F}, m.of(PropFinish::paint));
    m.build.box(
        {-m.x + .4F, m.y - .5F, .42F}, {m.x - .5F, m.y - .14F, .47F}, m.of(PropFinish::timber));
    for (const float x : {-m.x + .6F, m.x - .7F})
        m.build.box({x - .03F, m.y - .36F, 0}, {x + .03F, m.y - .3F, .42F}, steel);
    const float post = -m.x - .45F;
    m.build.tube({{post, -m.y + .3F, -.1F}, {post, -m.y + .3F, m.height + .3F}, .035F, .035F, 8},
                 m.of(PropFinish::steel));
    m.build.box({post - .26F, -m.y + .285F, m.height - .3F},
                {post + .26F, -m.y + .315F, m.height + .3F},
                m.of(PropFinish::plate));
}

void add_bin(Maker& m) {
    const float radius = std::min(m.x, m.y);
    m.build.lathe({0, 0, 0},
                  {{0, 0},
                   {radius * .82F, 0},
                   {radius, m.height * .82F},
                   {radius * 1.06F, m.height * .83F},
                   {radius * 1.06F, m.height * .87F},
                   {radius * .6F, m.height},
                   {0, m.height}},
                  16,
                  m.of(PropFinish::paint));
    m.build.box({-radius * .55F, -radius * .93F, m.height * .885F},
                {radius * .55F, -radius * .5F, m.height * .955F},
                m.of(PropFinish::iron));
}

void add_bollard(Maker& m) {
    const float radius = std::min(m.x, m.y);
    m.build.lathe({0, 0, 0},
                  {{0, -.1F}, {radius, -.1F}, {radius, m.height - .22F}},
                  12,
                  m.of(PropFinish::iron));
    m.build.lathe({0, 0, 0},
                  {{radius, m.height - .22F}, {radius, m.height - .12F}},
                  12,
                  m.of(PropFinish::coping));
    m.build.lathe({0, 0, 0},
                  {{radius, m.height - .12F},
                   {radius, m.height - .05F},
                   {radius * .6F, m.height},
                   {0, m.height}},
                  12,
                  m.of(PropFinish::iron));
}

void add_hydrant(Maker& m) {
    const Finish paint = m.of(PropFinish::paint);
    const float r = 0.62F * std::min(m.x, m.y);
    const float h = m.height;
    m.build.lathe({0, 0, 0},
                  {{0, 0},
                   {r * 1.5F, 0},
                   {r * 1.5F, .05F * h},
                   {r, .07F * h},
                   {r, .70F * h},
                   {r * 1.25F, .72F * h},
                   {r * 1.25F, .77F * h},
                   {r * .8F, .92F * h},
                   {r * .3F, .94F * h},
                   {r * .3F, h},
                   {0, h}},
                  14,
                  paint);
    for (const Vector3f& out : {Vector3f(1, 0, 0), Vector3f(-1, 0, 0), Vector3f(0, -1, 0)}) {
        const Vector3f at(0, 0, .55F * h);
        m.build.tube({at, at + out * m.x, r * .5F, r * .5F, 10}, paint);
        m.build.tube({at + out * m.x * .86F, at + out * m.x, r * .62F, r * .62F, 8},
                     m.of(PropFinish::steel));
    }
}

void add_mailbox(Maker& m) {
    const Finish paint = m.of(PropFinish::paint);
    const float foot = .35F;
    m.build.box(
        {-m.x * .3F, -m.y * .3F, -.05F}, {m.x * .3F, m.y * .3F, foot}, m.of(PropFinish::iron));
    const float shoulder = m.height - .8F * m.x;
    m.build.box({-m.x, -m.y, foot}, {m.x, m.y, shoulder}, paint);
    // A round top, as a fan of boxes' edges.
    const int steps = 8;
    for (int i = 0; i < steps; ++i) {
        const auto rim = [&](int step) {
            const double angle = 3.14159265 * step / steps;
            return Vector3f(m.x * static_cast<float>(std::cos(angle)),
                            0,
                            shoulder + .8F * m.x * static_cast<float>(std::sin(angle)));
        };
        const Vector3f from = rim(i);
        const Vector3f to = rim(i + 1);
        const Vector3f y(0, m.y, 0);
        m.build.quad({from - y, from + y, to + y, to - y}, paint);
        m.build.triangle({Vector3f(0, -m.y, shoulder), from - y, to - y}, paint);
        m.build.triangle({Vector3f(0, m.y, shoulder), to + y, from + y}, paint);
    }
    m.build.box({-m.x * .7F, -m.y - .02F, shoulder - .09F},
                {m.x * .7F, -m.y + .01F, shoulder - .03F},
                m.of(PropFinish::iron));
}

/// A basin with a stem and a bowl.
void add_fountain(Maker& m) {
    const float r = std::min(m.x, m.y);
    const float h = m.height;
    const Finish stone = m.of(PropFinish::concrete);
    m.build.lathe({0, 0, 0},
                  {{r, -.2F},
                   {r, .42F},
                   {r + .06F, .44F},
                   {r + .06F, .54F},
                   {r - .32F, .54F},
                   {r - .30F, .2F}},
                  32,
                  stone);
    m.build.lathe({0, 0, 0}, {{r - .28F, .40F}, {0, .40F}}, 32, m.of(PropFinish::water));
    m.build.lathe({0, 0, 0},
                  {{.45F, .1F},
                   {.40F, .5F},
                   {.16F, .62F},
                   {.13F, .62F * h},
                   {.2F, .66F * h},
                   {.46F * r, .74F * h},
                   {.50F * r, .80F * h},
                   {.46F * r, .80F * h},
                   {.40F * r, .775F * h}},
                  24,
                  stone);
    m.build.lathe({0, 0, 0}, {{.42F * r, .785F * h}, {0, .785F * h}}, 24, m.of(PropFinish::water));
    m.build.lathe(
        {0, 0, 0}, {{.1F, .78F * h}, {.06F, .93F * h}, {.12F, .95F * h}, {.0F, h}}, 12, stone);
}

void add_swing(Maker& m) {
    const Finish paint = m.of(PropFinish::paint);
    const float top = m.height;
    m.build.tube({{-m.x, 0, top}, {m.x, 0, top}, .045F, .045F, 10}, paint);
    for (const float x : {-m.x + .1F, m.x - .1F})
        for (const float y : {-m.y, m.y})
            m.build.tube({{x, y, -.1F}, {x, 0, top}, .04F, .04F, 8}, paint);
    for (const float x : {-.42F * m.x, .42F * m.x}) {
        for (const float side : {-.22F, .22F})
            m.build.tube({{x + side, 0, .48F}, {x + side, 0, top}, .009F, .009F, 4},
                         m.of(PropFinish::iron));
        m.build.box({x - .25F, -.09F, .44F}, {x + .25F, .09F, .48F}, m.of(PropFinish::timber));
    }
}

/// A picnic table with a bench on both sides.
void add_table(Maker& m) {
    const Finish timber = m.of(PropFinish::timber);
    for (int i = 0; i < 5; ++i) {
        const float y = -.36F + .145F * static_cast<float>(i);
        m.build.box({-m.x, y, m.height - .045F}, {m.x, y + .135F, m.height}, timber);
    }
    for (const float side : {-1.0F, 1.0F}) {
        const float y = side * (m.y - .14F);
        m.build.box({-m.x, y - .13F, .42F}, {m.x, y + .13F, .46F}, timber);
        const float x = side * m.x * .68F;
        m.build.box({x - .04F, -m.y + .1F, .34F}, {x + .04F, m.y - .1F, .42F}, timber);
        for (const float lean : {-1.0F, 1.0F})
            m.build.tube(
                {{x, lean * .62F, -.05F}, {x, lean * .26F, m.height - .04F}, .05F, .05F, 4},
                timber);
    }
}

}  // namespace

void add_street_furniture(Mesh& mesh, PropKind kind, const PropSize& size) {
    Eigen::Isometry3f frame = Eigen::Isometry3f::Identity();
    if (kind == PropKind::bench || kind == PropKind::bus_stop)
        frame.linear() = Vector3f(-1, -1, 1).asDiagonal();
    Maker m{Builder(mesh, frame), kind, 0.5F * size.length, 0.5F * size.width, size.height};
    switch (kind) {
        case PropKind::bench:
            return add_bench(m);
        case PropKind::bus_stop:
            return add_bus_stop(m);
        case PropKind::bin:
            return add_bin(m);
        case PropKind::bollard:
            return add_bollard(m);
        case PropKind::hydrant:
            return add_hydrant(m);
        case PropKind::mailbox:
            return add_mailbox(m);
        case PropKind::fountain:
            return add_fountain(m);
        case PropKind::swing:
            return add_swing(m);
        case PropKind::table:
            return add_table(m);
        default:
            // A plain pole.
            m.build.tube({{0, 0, -.1F}, {0, 0, size.height}, .075F, .06F, 12},
                         m.of(PropFinish::steel));
    }
}

}  // namespace reprise::render

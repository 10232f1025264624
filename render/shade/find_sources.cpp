#include "render/look/lamp_colors.h"
#include "render/shade/light_source.h"
#include "world/models/actors.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using Lobe = LightSource::Lobe;

constexpr float far_street_lights = 330;  // [m]
constexpr float far_small = 150;          // [m] cars, signals, windows

/// [cd] over pi, in the sky's unit.
constexpr float candela = lux / pi;

/// Collects what shines; far ones fade, so that nothing begins to shine from one tick to the next.
class Collection {
  public:
    Collection(const ShadingInput& input, const Vector3f& eye)
        : input_(input),
          eye_(eye),
          far_shine_(1 + 1.5F * input.sky.weather().wetness()) {}

    void add(LightSource source, float far) {
        const float away = (source.position - eye_).norm();
        if (away > far)
            return;
        const float seen = smooth_step(far, 0.75F * far, away);
        source.intensity *= seen;
        if (source.intensity.maxCoeff() > 0)
            sources_.push_back(source);
    }

    void add_lens(const Vector3f& position,
                  const Vector3f& facing,
                  const Color& color,
                  float candelas,
                  float reach,
                  Lobe lobe) {
        add({position,
             facing,
             Vector3f::Zero(),
             color * (candelas * candela),
             reach * far_shine_,
             0.1F,
             lobe},
            far_small);
    }

    void add_street_lights();
    void add_heads();
    void add_shop_windows();
    void add_car(const Instance& car);

    std::vector<LightSource> take() { return std::move(sources_); }

  private:
    void add_low_beams(const Instance& car, float share);
    void add_car_lens(const Instance& car,
                      const Vector3f& local,
                      const Vector3f& facing,
                      const Color& color,
                      float candelas);

    const ShadingInput& input_;
    Vector3f eye_;
    float far_shine_;  // how much farther a lens is seen on wet ground than it lights a dry one
    std::vector<LightSource> sources_;
};

void Collection::add_street_lights() {
    // 5,000 lm on 7.5 m: 15 to 20 lx below, 3 between two lamps (EN 13201, class M4).
    for (const TownLamps::StreetLight& light : input_.scene.town().lamps().street_lights)
        add({light.position,
             -Vector3f::UnitZ(),
             Vector3f::Zero(),
             street_lamp_color * ((light.lantern ? 170 : 1000) * candela * input_.sky.lamplight()),
             light.lantern ? 18.0F : 38.0F,
             light.lantern ? 0.12F : 0.25F,
             light.lantern ? Lobe::lantern : Lobe::street},
            far_street_lights);
}

void Collection::add_heads() {
    using world::SignalColor;
    const auto signals = input_.scene.signals();
    for (const TownLamps::Head& head : input_.scene.town().lamps().heads) {
        if (head.signal >= signals.size())
            continue;
        const SignalColor color = signals[head.signal];
        const float lamps = head.for_walkers ? 2 : 3;
        const auto shine = [&](const Color& light, float place) {
            const Vector3f down(0, 0, head.height * (place + 0.5F) / lamps);
            // EN 12368: some 200 cd for drivers.
            add_lens(head.top - down + 0.1F * head.facing,
                     head.facing,
                     light,
                     (head.for_walkers ? 40.0F : 200.0F) * input_.sky.lamplight(),
                     14,
                     Lobe::signal);
        };
        if (color == SignalColor::red || color == SignalColor::red_yellow ||
            color == SignalColor::stop)
            shine(lens_red, 0);
        if (!head.for_walkers && (color == SignalColor::yellow || color == SignalColor::red_yellow))
            shine(lens_amber, 1);
        if (color == SignalColor::green || color == SignalColor::green_minor)
            shine(lens_green, lamps - 1);
    }
}

void Collection::add_shop_windows() {
    for (const TownLamps::ShopWindow& window : input_.scene.town().lamps().shop_windows) {
        const float lit = room_light(input_.sky, window.fate, 0.75F);
        // 40 cd/m2: a display that is lit from above, its back wall dark.
        if (lit > 0)
            add({window.position,
                 window.facing,
                 Vector3f::Zero(),
                 head_lamp_color * (40 * window.area * lit * candela),
                 13,
                 0.8F,
                 Lobe::window},
                far_small);
    }
}

void Collection::add_low_beams(const Instance& car, float share) {
    const CarShape& shape = input_.scene.car_shape(car.model);
    const bool thin = world::is_two_wheeler(shape.model->body);
    const bool bicycle = shape.style == world::BodyStyle::bicycle;
    const float half = thin ? 0.0F : 0.72F * static_cast<float>(shape.model->width) / 2;
    const float height = thin ? 0.85F : shape.height() > 2.2F ? 0.85F : 0.66F;
    const Vector3f ahead = car.pose.linear().col(0).cast<float>().normalized();
    const Vector3f left = car.pose.linear().col(1).cast<float>().normalized();
    for (const float side : {half, -half}) {
        const Eigen::Vector3d lamp = Vector3f(shape.front + 0.06F, side, height).cast<double>();
        // A halogen lamp has some 15,000 cd below its line.
        add({(car.pose * lamp).cast<float>(),
             ahead,
             left,
             head_lamp_color * ((bicycle ? 900.0F : 15000.0F) * candela * share),
             bicycle ? 20.0F : 75.0F,
             0.08F,
             Lobe::low_beam},
            far_small);
        if (thin)
            break;
    }
}

void Collection::add_car_lens(const Instance& car,
                              const Vector3f& local,
                              const Vector3f& facing,
                              const Color& color,
                              float candelas) {
    const Eigen::Vector3d at = local.cast<double>();
    add_lens((car.pose * at).cast<float>(),
             (car.pose.linear().cast<float>() * facing).normalized(),
             color,
             candelas,
             9,
             Lobe::lens);
}

void Collection::add_car(const Instance& car) {
    const CarShape& shape = input_.scene.car_shape(car.model);
    if (car.kind != Kind::car_body ||
        car.prototype != input_.scene.town().prototypes().car_bodies[car.model].get())
        return;  // a door, a fork
    // By day they shine as well, but light up nothing.
    const float dark = input_.sky.lamplight();
    add_low_beams(car, low_beam(car.lamps, input_.sky) * dark);
    const bool brakes = (car.lamps & world::lamp_brake) != 0;
    const float red = (brakes ? 90.0F : 8 * low_beam(car.lamps, input_.sky)) * dark;
    add_car_lens(car, {shape.rear - 0.08F, 0, 0.85F}, {-1, 0, 0}, lens_red, red);
    const float half = static_cast<float>(shape.model->width) / 2;
    for (const float side : {1.0F, -1.0F}) {
        if ((car.lamps & (side > 0 ? world::lamp_left : world::lamp_right)) == 0 ||
            !flashes_now(input_.tick, car.actor))
            continue;
        add_car_lens(car,
                     {shape.rear - 0.06F, side * half, 0.85F},
                     Vector3f(-1, 0.7F * side, 0).normalized(),
                     lens_amber,
                     110 * dark);
        add_car_lens(car,
                     {shape.front + 0.06F, side * half, 0.7F},
                     Vector3f(1, 0.7F * side, 0).normalized(),
                     lens_amber,
                     110 * dark);
    }
    if ((car.lamps & world::lamp_reverse) != 0)
        add_car_lens(car, {shape.rear - 0.08F, 0, 0.8F}, {-1, 0, 0}, head_lamp_color, 120 * dark);
}

}  // namespace

std::vector<LightSource> find_sources(const ShadingInput& input, const Vector3f& eye) {
    Collection found(input, eye);
    if (input.sky.lamplight() <= 0)
        return {};
    found.add_street_lights();
    found.add_heads();
    found.add_shop_windows();
    for (const Instance& instance : input.scene.moving())
        found.add_car(instance);
    return found.take();
}

}  // namespace reprise::render

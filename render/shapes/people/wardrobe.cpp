#include "render/shapes/people/wardrobe.h"

#include <array>
#include <span>
#include <string_view>

#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using world::Age;
using world::Clothing;

/// What the bits choose: each question has a salt of its own.
class Choice {
  public:
    explicit Choice(std::uint32_t look) : look_(look) {}

    float share(std::uint32_t salt) const { return unit(hash(look_, salt)); }

    const Color& of(std::span<const Color> colors, std::uint32_t salt) const {
        return colors[hash(look_, salt) % colors.size()];
    }

  private:
    std::uint32_t look_;
};

const std::array<Color, 7> skins{Color(.60F, .40F, .31F),
                                 Color(.64F, .45F, .36F),
                                 Color(.52F, .34F, .25F),
                                 Color(.40F, .245F, .165F),
                                 Color(.28F, .165F, .11F),
                                 Color(.15F, .085F, .058F),
                                 Color(.57F, .41F, .29F)};
const std::array<Color, 7> hairs{Color(.012F, .010F, .009F),
                                 Color(.03F, .02F, .015F),
                                 Color(.06F, .035F, .02F),
                                 Color(.11F, .06F, .03F),
                                 Color(.28F, .19F, .085F),
                                 Color(.40F, .31F, .16F),
                                 Color(.20F, .06F, .025F)};
const std::array<Color, 14> tops{Color(.45F, .05F, .05F),
                                 Color(.06F, .12F, .32F),
                                 Color(.58F, .57F, .55F),
                                 Color(.03F, .03F, .034F),
                                 Color(.10F, .26F, .16F),
                                 Color(.60F, .38F, .06F),
                                 Color(.32F, .36F, .42F),
                                 Color(.30F, .12F, .22F),
                                 Color(.13F, .135F, .14F),
                                 Color(.18F, .30F, .46F),
                                 Color(.46F, .40F, .30F),
                                 Color(.55F, .22F, .16F),
                                 Color(.04F, .055F, .10F),
                                 Color(.20F, .24F, .11F)};
const std::array<Color, 8> bottoms{Color(.035F, .05F, .10F),
                                   Color(.025F, .026F, .03F),
                                   Color(.26F, .21F, .15F),
                                   Color(.10F, .13F, .20F),
                                   Color(.12F, .12F, .125F),
                                   Color(.06F, .08F, .15F),
                                   Color(.16F, .13F, .10F),
                                   Color(.08F, .09F, .06F)};
const std::array<Color, 6> suits{Color(.022F, .024F, .034F),
                                 Color(.028F, .028F, .030F),
                                 Color(.09F, .092F, .10F),
                                 Color(.05F, .055F, .075F),
                                 Color(.13F, .11F, .09F),
                                 Color(.17F, .17F, .17F)};
const std::array<Color, 8> brights{Color(.62F, .06F, .05F),
                                   Color(.04F, .16F, .50F),
                                   Color(.66F, .36F, .03F),
                                   Color(.05F, .36F, .20F),
                                   Color(.62F, .55F, .06F),
                                   Color(.42F, .07F, .30F),
                                   Color(.62F, .61F, .58F),
                                   Color(.04F, .36F, .42F)};
const std::array<Color, 5> shoes{Color(.03F, .028F, .026F),
                                 Color(.10F, .06F, .035F),
                                 Color(.55F, .55F, .54F),
                                 Color(.025F, .025F, .03F),
                                 Color(.22F, .15F, .10F)};

const Color safety_yellow(.60F, .66F, .04F);
const Color safety_orange(.70F, .20F, .02F);

/// Uniforms and the like are no free choice.
void dress_by_trade(Outfit& outfit, std::string_view name) {
    struct Trade {
        std::string_view name;
        Color shirt, trousers, headgear;
    };

    static const std::array<Trade, 13> trades{{
        {"police_officer", {.03F, .045F, .10F}, {.022F, .028F, .05F}, {.022F, .03F, .06F}},
        {"policewoman", {.03F, .045F, .10F}, {.022F, .028F, .05F}, {.022F, .03F, .06F}},
        {"firefighter", {.05F, .045F, .04F}, {.05F, .045F, .04F}, {.58F, .50F, .06F}},
        {"builder", {.30F, .30F, .31F}, {.05F, .07F, .12F}, {.62F, .52F, .05F}},
        {"road_worker", {.55F, .16F, .02F}, {.55F, .16F, .02F}, {.55F, .16F, .02F}},
        {"mechanic", {.04F, .075F, .18F}, {.04F, .075F, .18F}, {.03F, .05F, .12F}},
        {"postman", {.05F, .10F, .26F}, {.03F, .04F, .07F}, {.05F, .10F, .26F}},
        {"nurse", {.20F, .45F, .48F}, {.20F, .45F, .48F}, {.5F, .5F, .5F}},
        {"doctor", {.62F, .62F, .61F}, {.06F, .08F, .15F}, {.5F, .5F, .5F}},
        {"chef", {.62F, .62F, .60F}, {.13F, .13F, .135F}, {.64F, .64F, .62F}},
        {"waiter", {.03F, .03F, .032F}, {.022F, .022F, .024F}, {.1F, .1F, .1F}},
        {"nun", {.022F, .022F, .026F}, {.022F, .022F, .026F}, {.022F, .022F, .026F}},
        {"gardener", {.09F, .17F, .06F}, {.09F, .12F, .06F}, {.42F, .33F, .16F}},
    }};
    for (const Trade& trade : trades) {
        if (trade.name != name)
            continue;
        outfit.shirt = trade.shirt;
        outfit.trousers = trade.trousers;
        outfit.headgear = trade.headgear;
    }
}

void choose_clothes(Outfit& outfit, const world::WalkerModel& model, const Choice& choice) {
    outfit.shirt = choice.of(tops, 2);
    outfit.trousers = choice.of(bottoms, 3);
    outfit.headgear = choice.of(brights, 6) * 0.6F;
    outfit.trim = Color(.03F, .026F, .024F);
    outfit.short_sleeves = choice.share(7) < 0.35F;
    switch (model.clothing) {
        case Clothing::suit:
            outfit.shirt = outfit.trousers = choice.of(suits, 2);
            outfit.trim = choice.of(brights, 8) * 0.7F;
            outfit.headgear = Color(.60F, .60F, .61F);
            outfit.short_sleeves = false;
            break;
        case Clothing::sportswear:
            outfit.shirt = choice.of(brights, 2);
            outfit.short_sleeves = choice.share(7) < 0.7F;
            break;
        case Clothing::shorts:
            outfit.short_sleeves = true;
            break;
        case Clothing::dress:
            outfit.shirt = outfit.trousers = choice.of(brights, 2) * 0.8F;
            outfit.short_sleeves = choice.share(7) < 0.6F;
            break;
        case Clothing::gown:
            outfit.shirt = outfit.trousers = choice.of(tops, 2) * 0.6F;
            outfit.short_sleeves = false;
            break;
        case Clothing::coat:
        case Clothing::uniform:
            outfit.short_sleeves = false;
            break;
        case Clothing::workwear:
            outfit.trim = choice.share(8) < 0.6F ? safety_yellow : safety_orange;
            outfit.short_sleeves = false;
            break;
        case Clothing::casual:
        case Clothing::skirt:
            break;
    }
}

}  // namespace

const Color& Outfit::color_of(Material material) const {
    static const Color eyes(.02F, .017F, .015F);
    switch (material) {
        case Material::eye:
            return eyes;
        case Material::hair:
            return hair;
        case Material::headgear:
            return headgear;
        case Material::shirt:
            return shirt;
        case Material::trousers:
            return trousers;
        case Material::shoe:
            return shoe;
        case Material::trim:
            return trim;
        case Material::bag:
            return bag;
        case Material::umbrella:
            return umbrella;
        default:
            return skin;
    }
}

Outfit outfit_of(const world::WalkerModel& model, std::uint32_t look) {
    const Choice choice(look);
    Outfit outfit;
    outfit.skin = choice.of(skins, 1) * (0.9F + 0.2F * choice.share(11));
    outfit.hair = choice.of(hairs, 4);
    const float grey = model.age == Age::senior ? 0.95F : model.age == Age::adult ? 0.08F : 0;
    if (choice.share(12) < grey)
        outfit.hair = Color::Constant(.18F + .25F * choice.share(13));
    choose_clothes(outfit, model, choice);
    outfit.shoe = choice.of(shoes, 5);
    outfit.bag =
        choice.share(10) < 0.5F ? choice.of(bottoms, 9) : Color(choice.of(brights, 9) * 0.7F);
    outfit.umbrella = choice.share(15) < 0.5F ? Color(.02F, .02F, .024F) : choice.of(brights, 14);
    outfit.stockings = choice.share(16) < 0.4F;
    dress_by_trade(outfit, model.name);
    outfit.carried = world::carried_by(model, look);
    return outfit;
}

}  // namespace reprise::render

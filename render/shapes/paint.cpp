#include "render/shapes/paint.h"

#include <array>
#include <span>

#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using world::BodyStyle;

struct Tone {
    float share;
    Color color;
};

Color pick(std::span<const Tone> tones, float drawn) {
    float total = 0;
    for (const Tone& tone : tones)
        total += tone.share;
    float left = drawn * total;
    for (const Tone& tone : tones) {
        left -= tone.share;
        if (left < 0)
            return tone.color;
    }
    return tones.front().color;
}

/// Shares as paint makers report them for new cars (Axalta, "Global Automotive Color Popularity
/// Report"): white, black, grey and silver are three quarters.
std::span<const Tone> car_tones() {
    static const std::array<Tone, 15> tones{{{28, Color(.62F, .62F, .61F)},
                                             {12, Color(.024F, .025F, .028F)},
                                             {9, Color(.033F, .034F, .037F)},
                                             {10, Color(.13F, .135F, .145F)},
                                             {9, Color(.21F, .215F, .22F)},
                                             {6, Color(.34F, .345F, .35F)},
                                             {4, Color(.42F, .425F, .43F)},
                                             {5, Color(.035F, .075F, .24F)},
                                             {3, Color(.022F, .042F, .12F)},
                                             {2, Color(.09F, .23F, .36F)},
                                             {5, Color(.42F, .022F, .020F)},
                                             {2, Color(.25F, .016F, .022F)},
                                             {2, Color(.05F, .13F, .085F)},
                                             {2, Color(.34F, .26F, .17F)},
                                             {1, Color(.58F, .25F, .03F)}}};
    return tones;
}

std::span<const Tone> tones_of(BodyStyle body) {
    static const std::array<Tone, 7> fast{{{24, Color(.50F, .022F, .018F)},
                                           {18, Color(.022F, .023F, .026F)},
                                           {16, Color(.33F, .335F, .34F)},
                                           {14, Color(.62F, .62F, .61F)},
                                           {10, Color(.02F, .08F, .34F)},
                                           {10, Color(.66F, .42F, .02F)},
                                           {8, Color(.03F, .20F, .07F)}}};
    static const std::array<Tone, 6> works{{{58, Color(.62F, .62F, .60F)},
                                            {12, Color(.34F, .345F, .35F)},
                                            {8, Color(.10F, .105F, .11F)},
                                            {8, Color(.03F, .07F, .24F)},
                                            {7, Color(.45F, .03F, .025F)},
                                            {7, Color(.62F, .40F, .03F)}}};
    static const std::array<Tone, 5> public_transport{{{34, Color(.50F, .03F, .03F)},
                                                       {24, Color(.60F, .60F, .58F)},
                                                       {18, Color(.04F, .13F, .36F)},
                                                       {14, Color(.08F, .28F, .11F)},
                                                       {10, Color(.62F, .44F, .04F)}}};
    static const std::array<Tone, 7> bright{{{20, Color(.45F, .025F, .02F)},
                                             {22, Color(.022F, .023F, .026F)},
                                             {16, Color(.03F, .10F, .36F)},
                                             {12, Color(.55F, .55F, .54F)},
                                             {12, Color(.05F, .26F, .12F)},
                                             {10, Color(.60F, .26F, .02F)},
                                             {8, Color(.05F, .36F, .38F)}}};
    switch (body) {
        case BodyStyle::coupe:
            return fast;
        case BodyStyle::van:
        case BodyStyle::lorry:
        case BodyStyle::pickup:
        case BodyStyle::minibus:
            return works;
        case BodyStyle::bus:
            return public_transport;
        case BodyStyle::motorcycle:
        case BodyStyle::bicycle:
            return bright;
        default:
            return car_tones();
    }
}

}  // namespace

Paint paint_of(const world::VehicleModel& model, std::uint32_t look) {
    const float drawn = unit(hash(look, 11));
    const Color brand = pick(tones_of(BodyStyle::motorcycle), unit(hash(look, 12)));
    switch (model.livery) {
        case world::Livery::taxi:
            return {drawn < 0.55F   ? Color(.66F, .41F, .025F)
                    : drawn < 0.85F ? Color(.60F, .53F, .36F)
                                    : Color(.024F, .025F, .028F),
                    brand};
        case world::Livery::police:
            return {drawn < 0.8F ? Color(.62F, .62F, .61F) : Color(.36F, .37F, .38F), brand};
        case world::Livery::ambulance:
            return {drawn < 0.7F ? Color(.63F, .63F, .61F) : Color(.66F, .58F, .06F), brand};
        case world::Livery::plain:
            break;
    }
    return {pick(tones_of(model.body), drawn), brand};
}

}  // namespace reprise::render

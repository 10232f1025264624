#include <array>

#include "world/models/catalogue.h"

namespace reprise::world {

namespace {

// Heights and shoulders as anthropometric tables give them for the age (DIN 33402: adults of 5 to
// 95 %), walking speeds after Weidmann, "Transporttechnik der Fussgaenger", 1993: 1.34 m/s in the
// mean, less for children and the old.
// clang-format off
constexpr std::array<WalkerModel, 50> walkers{{
    // name              heigh shoul mas speed girth age          clothing              hair
    {"adult",          1.74, 0.46, 74, 1.35, 0.86, Age::adult,  Clothing::casual,     Hair::cropped},
    {"child",          1.22, 0.32, 24, 1.10, 0.58, Age::child,  Clothing::casual,     Hair::cropped},
    {"senior",         1.66, 0.44, 70, 0.95, 0.95, Age::senior, Clothing::casual,     Hair::cropped},
    {"office_worker",  1.78, 0.47, 78, 1.50, 0.88, Age::adult,  Clothing::suit,       Hair::cropped},
    {"businesswoman",  1.68, 0.41, 62, 1.45, 0.72, Age::adult,  Clothing::suit,       Hair::bun},
    {"manager",        1.82, 0.49, 92, 1.40, 1.04, Age::adult,  Clothing::suit,       Hair::cropped},
    {"commuter",       1.75, 0.46, 75, 1.60, 0.88, Age::adult,  Clothing::coat,       Hair::cropped},
    {"clerk",          1.66, 0.40, 60, 1.35, 0.72, Age::adult,  Clothing::skirt,      Hair::bob},
    {"student",        1.77, 0.45, 68, 1.45, 0.78, Age::adult,  Clothing::casual,     Hair::cropped},
    {"student_girl",   1.67, 0.39, 58, 1.40, 0.68, Age::adult,  Clothing::casual,     Hair::loose},
    {"schoolgirl",     1.30, 0.32, 28, 1.15, 0.58, Age::child,  Clothing::skirt,      Hair::loose},
    {"schoolboy",      1.28, 0.32, 28, 1.20, 0.60, Age::child,  Clothing::shorts,     Hair::cropped},
    {"toddler",        0.92, 0.25, 14, 0.75, 0.50, Age::child,  Clothing::casual,     Hair::cropped},
    {"girl",           1.12, 0.29, 20, 1.05, 0.54, Age::child,  Clothing::dress,      Hair::loose},
    {"boy",            1.16, 0.30, 22, 1.10, 0.56, Age::child,  Clothing::shorts,     Hair::cap},
    {"teenager",       1.70, 0.43, 60, 1.35, 0.74, Age::teen,   Clothing::casual,     Hair::cap},
    {"teen_girl",      1.62, 0.38, 52, 1.30, 0.66, Age::teen,   Clothing::shorts,     Hair::loose},
    {"skater",         1.72, 0.44, 63, 1.40, 0.76, Age::teen,   Clothing::shorts,     Hair::cap},
    {"runner",         1.78, 0.45, 68, 3.10, 0.78, Age::adult,  Clothing::sportswear, Hair::cropped},
    {"jogger",         1.66, 0.39, 56, 2.60, 0.66, Age::adult,  Clothing::sportswear, Hair::bun},
    {"athlete",        1.88, 0.51, 84, 1.55, 0.84, Age::adult,  Clothing::sportswear, Hair::cropped},
    {"builder",        1.80, 0.50, 88, 1.30, 0.96, Age::adult,  Clothing::workwear,   Hair::helmet},
    {"road_worker",    1.76, 0.48, 84, 1.20, 0.98, Age::adult,  Clothing::workwear,   Hair::cap},
    {"mechanic",       1.77, 0.48, 82, 1.35, 0.92, Age::adult,  Clothing::uniform,    Hair::cap},
    {"police_officer", 1.81, 0.49, 84, 1.35, 0.90, Age::adult,  Clothing::uniform,    Hair::cap},
    {"policewoman",    1.70, 0.42, 66, 1.35, 0.74, Age::adult,  Clothing::uniform,    Hair::bun},
    {"firefighter",    1.83, 0.51, 88, 1.45, 0.90, Age::adult,  Clothing::workwear,   Hair::helmet},
    {"postman",        1.75, 0.46, 74, 1.45, 0.86, Age::adult,  Clothing::uniform,    Hair::cap},
    {"courier",        1.76, 0.45, 70, 1.80, 0.80, Age::adult,  Clothing::sportswear, Hair::helmet},
    {"nurse",          1.67, 0.41, 64, 1.45, 0.74, Age::adult,  Clothing::uniform,    Hair::bun},
    {"doctor",         1.76, 0.45, 74, 1.40, 0.84, Age::adult,  Clothing::coat,       Hair::cropped},
    {"chef",           1.74, 0.48, 90, 1.25, 1.06, Age::adult,  Clothing::uniform,    Hair::hat},
    {"waiter",         1.78, 0.46, 72, 1.40, 0.82, Age::adult,  Clothing::suit,       Hair::cropped},
    {"gardener",       1.72, 0.46, 76, 1.20, 0.94, Age::adult,  Clothing::workwear,   Hair::hat},
    {"tourist",        1.73, 0.47, 84, 1.05, 1.02, Age::adult,  Clothing::shorts,     Hair::hat},
    {"traveller",      1.69, 0.41, 64, 1.35, 0.74, Age::adult,  Clothing::coat,       Hair::loose},
    {"backpacker",     1.80, 0.47, 76, 1.30, 0.82, Age::adult,  Clothing::shorts,     Hair::cap},
    {"hiker",          1.74, 0.46, 74, 1.35, 0.88, Age::adult,  Clothing::sportswear, Hair::hat},
    {"musician",       1.79, 0.45, 70, 1.25, 0.80, Age::adult,  Clothing::casual,     Hair::loose},
    {"artist",         1.70, 0.40, 60, 1.20, 0.70, Age::adult,  Clothing::gown,       Hair::bun},
    {"dancer",         1.68, 0.39, 54, 1.45, 0.62, Age::adult,  Clothing::dress,      Hair::bun},
    {"shopper",        1.66, 0.42, 68, 1.15, 0.82, Age::adult,  Clothing::dress,      Hair::bob},
    {"mother",         1.68, 0.41, 66, 1.20, 0.78, Age::adult,  Clothing::skirt,      Hair::loose},
    {"father",         1.81, 0.49, 88, 1.25, 0.98, Age::adult,  Clothing::casual,     Hair::bald},
    {"nun",            1.64, 0.42, 66, 1.05, 0.84, Age::adult,  Clothing::gown,       Hair::scarf},
    {"woman_in_scarf", 1.65, 0.41, 65, 1.20, 0.80, Age::adult,  Clothing::gown,       Hair::scarf},
    {"gentleman",      1.77, 0.46, 80, 1.10, 0.96, Age::senior, Clothing::coat,       Hair::hat},
    {"grandmother",    1.57, 0.41, 64, 0.80, 0.94, Age::senior, Clothing::skirt,      Hair::bun},
    {"grandfather",    1.70, 0.44, 74, 0.85, 0.98, Age::senior, Clothing::casual,     Hair::bald},
    {"pensioner",      1.63, 0.42, 72, 0.90, 1.00, Age::senior, Clothing::coat,       Hair::bob},
}};
// clang-format on

}  // namespace

std::span<const WalkerModel> walker_models() {
    return walkers;
}

}  // namespace reprise::world

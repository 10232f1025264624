#include <array>

#include "world/models/catalogue.h"

namespace reprise::world {

namespace {

using enum BodyStyle;

// Typical vehicles of their kind: kerb weight plus 150 kg of people and luggage (two-wheelers: a
// rider of 80 kg). Power of a cyclist: what a fit one gives for some minutes.
// clang-format off
constexpr std::array<VehicleModel, 16> vehicles{{
    // name          body        livery             length width heigh w.bas overh wheel  track mass   power  force  steer drag  SUMO class
    {"sedan",      sedan,      Livery::plain,     4.70,  1.82, 1.45, 2.80, 1.00, 0.32,  1.57, 1550,  110e3, 6500,  0.61, 0.64, "passenger"},
    {"hatchback",  hatchback,  Livery::plain,     4.05,  1.75, 1.47, 2.55, 0.70, 0.31,  1.50, 1250,  75e3,  5200,  0.63, 0.66, "passenger"},
    {"suv",        suv,        Livery::plain,     4.60,  1.88, 1.68, 2.70, 0.98, 0.36,  1.60, 1850,  130e3, 7800,  0.60, 0.86, "passenger"},
    {"van",        van,        Livery::plain,     5.30,  1.97, 1.97, 3.20, 1.10, 0.34,  1.66, 2300,  100e3, 8000,  0.62, 1.05, "delivery"},
    {"lorry",      lorry,      Livery::plain,     8.00,  2.45, 3.20, 4.50, 2.20, 0.48,  1.95, 9000,  180e3, 28000, 0.70, 5.0,  "truck"},
    {"bus",        bus,        Livery::plain,     11.90, 2.52, 3.05, 5.90, 3.30, 0.48,  2.05, 13000, 210e3, 36000, 0.80, 5.2,  "bus"},
    {"city_car",   hatchback,  Livery::plain,     3.60,  1.64, 1.50, 2.42, 0.56, 0.285, 1.43, 1100,  52e3,  4300,  0.65, 0.62, "passenger"},
    {"wagon",      wagon,      Livery::plain,     4.78,  1.84, 1.48, 2.83, 1.06, 0.32,  1.58, 1700,  110e3, 6500,  0.61, 0.66, "passenger"},
    {"coupe",      coupe,      Livery::plain,     4.52,  1.86, 1.30, 2.48, 1.08, 0.335, 1.60, 1620,  300e3, 11500, 0.58, 0.64, "passenger"},
    {"pickup",     pickup,     Livery::plain,     5.35,  1.90, 1.82, 3.22, 1.24, 0.37,  1.60, 2250,  120e3, 8500,  0.58, 0.98, "passenger"},
    {"taxi",       sedan,      Livery::taxi,      4.90,  1.85, 1.47, 2.94, 1.05, 0.33,  1.60, 1800,  120e3, 6800,  0.61, 0.66, "taxi"},
    {"police",     wagon,      Livery::police,    4.85,  1.85, 1.50, 2.85, 1.08, 0.33,  1.59, 1850,  160e3, 7500,  0.61, 0.75, "authority"},
    {"ambulance",  van,        Livery::ambulance, 5.95,  2.02, 2.65, 3.67, 1.22, 0.345, 1.72, 3500,  120e3, 9500,  0.62, 1.9,  "emergency"},
    {"minibus",    minibus,    Livery::plain,     6.95,  2.02, 2.75, 4.32, 1.62, 0.345, 1.74, 3900,  120e3, 9500,  0.62, 1.9,  "bus"},
    {"motorcycle", motorcycle, Livery::plain,     2.12,  0.82, 1.75, 1.44, 0.34, 0.30,  0.45, 290,   55e3,  1900,  0.45, 0.42, "motorcycle"},
    {"bicycle",    bicycle,    Livery::plain,     1.80,  0.62, 1.74, 1.06, 0.35, 0.345, 0.40, 98,    250,   130,   0.50, 0.50, "bicycle"},
}};
// clang-format on

}  // namespace

std::span<const VehicleModel> vehicle_models() {
    return vehicles;
}

}  // namespace reprise::world

#include "world/catalogue.h"

#include <array>

namespace reprise::world {

namespace {

// Typical cars of their kind: kerb weight plus 150 kg of people and luggage.
constexpr std::array<VehicleModel, 6> vehicles{{
    {"sedan",
     BodyStyle::sedan,
     4.70,
     1.82,
     1.45,
     2.80,
     1.00,
     0.32,
     1.57,
     1550,
     110e3,
     6500,
     0.61,
     0.64,
     "passenger"},
    {"hatchback",
     BodyStyle::hatchback,
     4.05,
     1.75,
     1.47,
     2.55,
     0.70,
     0.31,
     1.50,
     1250,
     75e3,
     5200,
     0.63,
     0.66,
     "passenger"},
    {"suv",
     BodyStyle::suv,
     4.60,
     1.88,
     1.68,
     2.70,
     0.98,
     0.36,
     1.60,
     1850,
     130e3,
     7800,
     0.60,
     0.86,
     "passenger"},
    {"van",
     BodyStyle::van,
     5.30,
     1.97,
     1.97,
     3.20,
     1.10,
     0.34,
     1.66,
     2300,
     100e3,
     8000,
     0.62,
     1.05,
     "delivery"},
    {"lorry",
     BodyStyle::lorry,
     8.00,
     2.45,
     3.20,
     4.50,
     2.20,
     0.48,
     1.95,
     9000,
     180e3,
     28000,
     0.70,
     5.0,
     "truck"},
    {"bus",
     BodyStyle::bus,
     11.90,
     2.52,
     3.05,
     5.90,
     3.30,
     0.48,
     2.05,
     13000,
     210e3,
     36000,
     0.80,
     5.2,
     "bus"},
}};

constexpr std::array<WalkerModel, 3> walkers{{
    {"adult", 1.74, 0.46, 74, 1.35},
    {"child", 1.22, 0.32, 24, 1.10},
    {"senior", 1.66, 0.44, 70, 0.95},
}};

template <typename Models>
std::optional<std::uint16_t> find_model(const Models& models, std::string_view name) {
    for (std::size_t i = 0; i < models.size(); ++i)
        if (name == models[i].name)
            return static_cast<std::uint16_t>(i);
    return std::nullopt;
}

}  // namespace

std::span<const VehicleModel> vehicle_models() {
    return vehicles;
}

std::optional<std::uint16_t> find_vehicle_model(std::string_view name) {
    return find_model(vehicles, name);
}

std::span<const WalkerModel> walker_models() {
    return walkers;
}

std::optional<std::uint16_t> find_walker_model(std::string_view name) {
    return find_model(walkers, name);
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const VehicleModel& model : vehicles)
        names.emplace_back(model.name);
    for (const WalkerModel& model : walkers)
        names.emplace_back(model.name);
    return names;
}

}  // namespace reprise::world

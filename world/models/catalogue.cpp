#include "world/models/catalogue.h"

#include "world/models/prop_models.h"

namespace reprise::world {

namespace {

template <typename Models>
std::optional<std::uint16_t> find_model(const Models& models, std::string_view name) {
    for (std::size_t i = 0; i < models.size(); ++i)
        if (name == models[i].name)
            return static_cast<std::uint16_t>(i);
    return std::nullopt;
}

}  // namespace

std::optional<std::uint16_t> find_vehicle_model(std::string_view name) {
    return find_model(vehicle_models(), name);
}

std::optional<std::uint16_t> find_walker_model(std::string_view name) {
    return find_model(walker_models(), name);
}

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const VehicleModel& model : vehicle_models())
        names.emplace_back(model.name);
    for (const WalkerModel& model : walker_models())
        names.emplace_back(model.name);
    for (const PropModel& model : prop_models())
        names.emplace_back(model.name);
    return names;
}

}  // namespace reprise::world

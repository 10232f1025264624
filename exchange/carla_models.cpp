#include "exchange/carla_models.h"

#include <cmath>
#include <string_view>

#include "world/catalogue.h"
#include "world/check.h"

namespace reprise::exchange {

namespace {

/// The nearest of our models by kind and size, and what stands in where the catalogue lacks it.
struct Row {
    std::string_view carla;
    std::string_view model;
    std::string_view otherwise;
};

/// Blueprints of CARLA 0.9.8 to 0.10; one stands for all that begin like it.
constexpr Row vehicles[] = {
    {"vehicle.ambulance", "ambulance", "van"},
    {"vehicle.audi.a2", "hatchback", "hatchback"},
    {"vehicle.audi.etron", "suv", "suv"},
    {"vehicle.audi.tt", "coupe", "hatchback"},
    {"vehicle.bh.crossbike", "bicycle", "hatchback"},
    {"vehicle.bmw.grandtourer", "wagon", "suv"},
    {"vehicle.bmw.isetta", "city_car", "hatchback"},
    {"vehicle.carlacola", "lorry", "lorry"},
    {"vehicle.carlamotors.carlacola", "lorry", "lorry"},
    {"vehicle.carlamotors.european_hgv", "lorry", "lorry"},
    {"vehicle.carlamotors.firetruck", "lorry", "lorry"},
    {"vehicle.chevrolet.impala", "sedan", "sedan"},
    {"vehicle.citroen.c3", "hatchback", "hatchback"},
    {"vehicle.diamondback.century", "bicycle", "hatchback"},
    {"vehicle.dodge.charger_police", "police", "sedan"},
    {"vehicle.dodge.charger", "sedan", "sedan"},
    {"vehicle.dodge_charger.police", "police", "sedan"},
    {"vehicle.dodgecop.charger", "police", "sedan"},
    {"vehicle.firetruck", "lorry", "lorry"},
    {"vehicle.ford.ambulance", "ambulance", "van"},
    {"vehicle.ford.crown", "taxi", "sedan"},
    {"vehicle.ford.mustang", "coupe", "sedan"},
    {"vehicle.fuso.mitsubishi", "minibus", "bus"},
    {"vehicle.gazelle.omafiets", "bicycle", "hatchback"},
    {"vehicle.harley-davidson.low", "motorcycle", "hatchback"},
    {"vehicle.jeep.wrangler", "suv", "suv"},
    {"vehicle.kawasaki.ninja", "motorcycle", "hatchback"},
    {"vehicle.lincoln", "sedan", "sedan"},
    {"vehicle.mercedes.coupe", "coupe", "sedan"},
    {"vehicle.mercedes.sprinter", "van", "van"},
    {"vehicle.mercedes-benz.coupe", "coupe", "sedan"},
    {"vehicle.micro.microlino", "city_car", "hatchback"},
    {"vehicle.mini.cooper", "hatchback", "hatchback"},
    {"vehicle.mitsubishi.fusorosa", "minibus", "bus"},
    {"vehicle.nissan.micra", "hatchback", "hatchback"},
    {"vehicle.nissan.patrol", "suv", "suv"},
    {"vehicle.seat.leon", "hatchback", "hatchback"},
    {"vehicle.sprinter", "van", "van"},
    {"vehicle.taxi", "taxi", "sedan"},
    {"vehicle.tesla.cybertruck", "pickup", "suv"},
    {"vehicle.tesla.model3", "sedan", "sedan"},
    {"vehicle.toyota.prius", "sedan", "sedan"},
    {"vehicle.vespa.zx125", "motorcycle", "hatchback"},
    {"vehicle.volkswagen.t2", "van", "van"},
    {"vehicle.yamaha.yzf", "motorcycle", "hatchback"},
};

/// What newer blueprints say in their attribute base_type.
constexpr Row base_types[] = {
    {"car", "sedan", "sedan"},
    {"truck", "lorry", "lorry"},
    {"van", "van", "van"},
    {"bus", "bus", "bus"},
    {"motorcycle", "motorcycle", "hatchback"},
    {"bicycle", "bicycle", "hatchback"},
};

std::uint16_t known(std::string_view name) {
    const auto model = world::find_vehicle_model(name);
    REPRISE_CHECK(model.has_value(), "a row of this table names no model of the catalogue");
    return *model;
}

CarlaModel of_row(const Row& row, const std::string& guessed_by) {
    if (const auto model = world::find_vehicle_model(row.model))
        return {*model, guessed_by};
    return {known(row.otherwise), guessed_by.empty() ? "as a stand-in" : guessed_by};
}

const std::string* attribute(const CarlaActor& actor, const std::string& key) {
    const auto found = actor.attributes.find(key);
    return found == actor.attributes.end() ? nullptr : &found->second;
}

/// The model whose box differs least, in metres of all three sides together.
std::uint16_t nearest_in_size(const CarlaBox& box) {
    const Eigen::Vector3d size = box.extent * 2 / 100;
    const auto models = world::vehicle_models();
    std::uint16_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint16_t i = 0; i < models.size(); ++i) {
        const Eigen::Vector3d ours(models[i].length, models[i].width, models[i].height);
        const double difference = (ours - size).cwiseAbs().sum();
        if (difference < least) {
            least = difference;
            best = i;
        }
    }
    return best;
}

bool is_sound(const CarlaBox& box) {
    return box.extent.minCoeff() > 10 && box.extent.maxCoeff() < 5000;  // [cm]
}

}  // namespace

CarlaModel vehicle_model_for(const CarlaActor& vehicle, const std::optional<CarlaBox>& box) {
    for (const Row& row : vehicles)
        if (vehicle.blueprint.starts_with(row.carla))
            return of_row(row, "");
    if (box && is_sound(*box))
        return {nearest_in_size(*box), "by its size"};
    if (const std::string* type = attribute(vehicle, "base_type"))
        for (const Row& row : base_types)
            if (*type == row.carla)
                return of_row(row, "by its type");
    const std::string* wheels = attribute(vehicle, "number_of_wheels");
    if (wheels != nullptr && *wheels == "2")
        return of_row({"", "motorcycle", "hatchback"}, "by its wheels");
    return {known("sedan"), "as any vehicle"};
}

CarlaModel walker_model_for(const CarlaActor& walker) {
    const auto named = [](const char* name) { return world::find_walker_model(name).value_or(0); };
    const std::string* age = attribute(walker, "age");
    if (age != nullptr && *age != "")
        return {named(*age == "child" || *age == "teenager" ? "child"
                      : *age == "elderly"                   ? "senior"
                                                            : "adult"),
                ""};
    // As CARLA's catalogue of pedestrians shows them.
    for (const char* child : {"0009", "0010", "0011", "0012", "0013", "0014", "0048", "0049"})
        if (walker.blueprint == std::string("walker.pedestrian.") + child)
            return {named("child"), ""};
    return {named("adult"), ""};
}

}  // namespace reprise::exchange

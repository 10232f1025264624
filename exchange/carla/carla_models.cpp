#include "exchange/carla/carla_models.h"

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "world/check.h"
#include "world/digest.h"
#include "world/models/catalogue.h"

namespace reprise::exchange {

namespace {

/// The nearest of our models by kind and size.
struct Row {
    std::string_view carla;
    std::string_view model;
};

/// Blueprints of CARLA 0.9.8 to 0.10; one stands for all that begin like it.
constexpr Row vehicles[] = {
    {"vehicle.ambulance", "ambulance"},
    {"vehicle.audi.a2", "hatchback"},
    {"vehicle.audi.etron", "suv"},
    {"vehicle.audi.tt", "coupe"},
    {"vehicle.bh.crossbike", "bicycle"},
    {"vehicle.bmw.grandtourer", "wagon"},
    {"vehicle.bmw.isetta", "city_car"},
    {"vehicle.carlacola", "lorry"},
    {"vehicle.carlamotors.carlacola", "lorry"},
    {"vehicle.carlamotors.european_hgv", "lorry"},
    {"vehicle.carlamotors.firetruck", "lorry"},
    {"vehicle.chevrolet.impala", "sedan"},
    {"vehicle.citroen.c3", "hatchback"},
    {"vehicle.diamondback.century", "bicycle"},
    {"vehicle.dodge.charger_police", "police"},
    {"vehicle.dodge.charger", "sedan"},
    {"vehicle.dodge_charger.police", "police"},
    {"vehicle.dodgecop.charger", "police"},
    {"vehicle.firetruck", "lorry"},
    {"vehicle.ford.ambulance", "ambulance"},
    {"vehicle.ford.crown", "taxi"},
    {"vehicle.ford.mustang", "coupe"},
    {"vehicle.fuso.mitsubishi", "minibus"},
    {"vehicle.gazelle.omafiets", "bicycle"},
    {"vehicle.harley-davidson.low", "motorcycle"},
    {"vehicle.jeep.wrangler", "suv"},
    {"vehicle.kawasaki.ninja", "motorcycle"},
    {"vehicle.lincoln", "sedan"},
    {"vehicle.mercedes.coupe", "coupe"},
    {"vehicle.mercedes.sprinter", "van"},
    {"vehicle.mercedes-benz.coupe", "coupe"},
    {"vehicle.micro.microlino", "city_car"},
    {"vehicle.mini.cooper", "hatchback"},
    {"vehicle.mitsubishi.fusorosa", "minibus"},
    {"vehicle.nissan.micra", "hatchback"},
    {"vehicle.nissan.patrol", "suv"},
    {"vehicle.seat.leon", "hatchback"},
    {"vehicle.sprinter", "van"},
    {"vehicle.taxi", "taxi"},
    {"vehicle.tesla.cybertruck", "pickup"},
    {"vehicle.tesla.model3", "sedan"},
    {"vehicle.toyota.prius", "sedan"},
    {"vehicle.vespa.zx125", "motorcycle"},
    {"vehicle.volkswagen.t2", "van"},
    {"vehicle.yamaha.yzf", "motorcycle"},
};

/// What newer blueprints say in their attribute base_type.
constexpr Row base_types[] = {
    {"car", "sedan"},
    {"truck", "lorry"},
    {"van", "van"},
    {"bus", "bus"},
    {"motorcycle", "motorcycle"},
    {"bicycle", "bicycle"},
};

std::uint16_t known(std::string_view name) {
    const auto model = world::find_vehicle_model(name);
    REPRISE_CHECK(model.has_value(), "a row of this table names no model of the catalogue");
    return *model;
}

const std::string* attribute(const CarlaActor& actor, const std::string& key) {
    const auto found = actor.attributes.find(key);
    return found == actor.attributes.end() ? nullptr : &found->second;
}

/// The model without a service's livery whose box differs least, in metres of all three sides
/// together.
std::uint16_t nearest_in_size(const CarlaBox& box) {
    const Eigen::Vector3d size = box.extent * 2 / 100;
    const auto models = world::vehicle_models();
    std::uint16_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint16_t i = 0; i < models.size(); ++i) {
        const Eigen::Vector3d ours(models[i].length, models[i].width, models[i].height);
        const double difference = (ours - size).cwiseAbs().sum();
        if (models[i].livery == world::Livery::plain && difference < least) {
            least = difference;
            best = i;
        }
    }
    return best;
}

world::Age age_of(const CarlaActor& walker) {
    if (const std::string* age = attribute(walker, "age"); age != nullptr && *age != "")
        return *age == "child"      ? world::Age::child
               : *age == "teenager" ? world::Age::teen
               : *age == "elderly"  ? world::Age::senior
                                    : world::Age::adult;
    // As CARLA's catalogue of pedestrians shows them.
    for (const char* child : {"0009", "0010", "0011", "0012", "0013", "0014", "0048", "0049"})
        if (walker.blueprint == std::string("walker.pedestrian.") + child)
            return world::Age::child;
    return world::Age::adult;
}

/// Nobody becomes a fireman by his number.
bool wears_own_clothes(const world::WalkerModel& model) {
    return model.clothing != world::Clothing::uniform &&
           model.clothing != world::Clothing::workwear;
}

/// The catalogue does not say; clothes and hair do.
bool is_womanly(const world::WalkerModel& model) {
    using enum world::Clothing;
    using enum world::Hair;
    return model.clothing == skirt || model.clothing == dress || model.clothing == gown ||
           model.hair == bob || model.hair == loose || model.hair == bun || model.hair == scarf;
}

bool is_sound(const CarlaBox& box) {
    return (box.extent.array() > 10).all() && (box.extent.array() < 5000).all();  // [cm]
}

}  // namespace

CarlaModel vehicle_model_for(const CarlaActor& vehicle, const std::optional<CarlaBox>& box) {
    for (const Row& row : vehicles)
        if (vehicle.blueprint.starts_with(row.carla))
            return {known(row.model), ""};
    if (box && is_sound(*box))
        return {nearest_in_size(*box), "by its size"};
    if (const std::string* type = attribute(vehicle, "base_type"))
        for (const Row& row : base_types)
            if (*type == row.carla)
                return {known(row.model), "by its type"};
    const std::string* wheels = attribute(vehicle, "number_of_wheels");
    if (wheels != nullptr && *wheels == "2")
        return {known("motorcycle"), "by its wheels"};
    return {known("sedan"), "as any vehicle"};
}

CarlaModel walker_model_for(const CarlaActor& walker) {
    const world::Age age = age_of(walker);
    const std::string* gender = attribute(walker, "gender");
    const auto models = world::walker_models();
    std::vector<std::uint16_t> fitting;
    for (std::uint16_t i = 0; i < models.size(); ++i)
        if (models[i].age == age && wears_own_clothes(models[i]) &&
            (gender == nullptr || *gender == "" || is_womanly(models[i]) == (*gender == "female")))
            fitting.push_back(i);
    REPRISE_CHECK(!fitting.empty(), "no pedestrian of age " + std::to_string(int(age)));
    world::Hasher hasher;
    hasher.add_text(walker.blueprint);
    return {fitting[hasher.digest64() % fitting.size()], ""};
}

}  // namespace reprise::exchange

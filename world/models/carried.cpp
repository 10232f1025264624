#include "world/models/carried.h"

#include <string_view>

#include "world/hash.h"

namespace reprise::world {

Carried carried_by(const WalkerModel& model, std::uint32_t look) {
    const std::string_view name = model.name;
    const bool young = model.age == Age::child;
    const bool sport = model.walking_speed > 2;
    const bool free = !young && !sport;
    // Each question has a salt of its own.
    const auto happens = [&](std::uint32_t salt, float share) {
        return unit(hash(look, salt)) < share;
    };
    Carried carried;
    carried.backpack = name == "backpacker" || name == "hiker" || name.starts_with("school") ||
                       name == "courier" ||
                       (happens(30, name.starts_with("student") ? 0.7F : 0.12F) && !sport);
    carried.guitar_case = !carried.backpack && free && (name == "musician" || happens(31, 0.025F));
    carried.rolling_bag = free && (name == "traveller" || happens(32, 0.05F));
    carried.suitcase =
        free && !carried.rolling_bag && happens(33, name == "manager" ? 0.5F : 0.04F);
    carried.umbrella = free && happens(34, 0.30F);
    carried.shopping_bags = free && !carried.umbrella && (name == "shopper" || happens(35, 0.10F));
    carried.phone = model.age != Age::child && !sport && !carried.rolling_bag &&
                    !carried.suitcase && happens(36, model.age == Age::teen ? 0.35F : 0.13F);
    return carried;
}

}  // namespace reprise::world

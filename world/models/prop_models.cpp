#include "world/models/prop_models.h"

#include <array>

namespace reprise::world {

namespace {

// Sizes and masses of usual ones: cone of 75 cm as on motorways (EN 13422, 5.5 kg); warning
// triangle (ECE R27: sides of 0.45 to 0.55 m); concrete barrier of 2 m (New Jersey profile, 80 cm
// high); EUR-pallet (EN 13698: 1.2 by 0.8 by 0.144 m, 25 kg); tyre 205/55 R16 on its rim; sign on a
// steel tube of 76 by 2.9 mm (5.2 kg/m).
// clang-format off
constexpr std::array<PropModel, 10> props{{
    // name                form                length width height  mass  grip  paint
    {"cone",             PropForm::cone,       0.40, 0.40, 0.75,    5.5, 0.70, 0xe8541a},
    {"barrier",          PropForm::barrier,    2.00, 0.60, 0.80, 1000.0, 0.80, 0xb4b2aa},
    {"plastic_barrier",  PropForm::barrier,    1.50, 0.45, 0.90,   12.0, 0.60, 0xd8231c},
    {"box",              PropForm::box,        0.60, 0.40, 0.40,    8.0, 0.60, 0xa8804e},
    {"crate",            PropForm::box,        1.20, 0.80, 0.95,   80.0, 0.70, 0x9c7a4a},
    {"pallet",           PropForm::box,        1.20, 0.80, 0.144,  25.0, 0.70, 0xb08d57},
    {"warning_triangle", PropForm::triangle,   0.45, 0.25, 0.42,    1.2, 0.70, 0xd01e16},
    {"plank",            PropForm::plank,      2.40, 0.20, 0.05,   11.0, 0.60, 0xb99a66},
    {"tyre",             PropForm::tyre,       0.63, 0.63, 0.21,   18.0, 0.90, 0x1c1c1e},
    {"sign_post",        PropForm::sign,       0.08, 0.60, 2.60,   18.0, 0.60, 0x9a9c9e},
}};
// clang-format on

}  // namespace

std::span<const PropModel> prop_models() {
    return props;
}

std::optional<std::uint16_t> find_prop_model(std::string_view name) {
    for (std::size_t i = 0; i < props.size(); ++i)
        if (name == props[i].name)
            return static_cast<std::uint16_t>(i);
    return std::nullopt;
}

}  // namespace reprise::world

#include "kernel/drill/real_fields.h"

#include <algorithm>

#include "world/tick.h"

namespace reprise::kernel {

namespace {

using flatbuffers::TypeTable;

void add_numbers(const TypeTable& type,
                 const std::string& prefix,
                 std::size_t offset,
                 std::vector<RealField>& numbers) {
    for (std::size_t i = 0; i < type.num_elems; ++i) {
        const flatbuffers::TypeCode code = type.type_codes[i];
        const std::string path = prefix + type.names[i];
        const std::size_t at = offset + static_cast<std::size_t>(type.values[i]);
        if (code.base_type == flatbuffers::ET_SEQUENCE)
            add_numbers(*type.type_refs[code.sequence_ref](), path + ".", at, numbers);
        else if (code.base_type == flatbuffers::ET_DOUBLE ||
                 code.base_type == flatbuffers::ET_FLOAT)
            numbers.push_back({path, at, code.base_type == flatbuffers::ET_DOUBLE});
    }
}

}  // namespace

std::vector<RealField> real_fields(const TypeTable& type, const std::string& prefix) {
    std::vector<RealField> numbers;
    add_numbers(type, prefix, 0, numbers);
    return numbers;
}

std::string wheel_prefix(unsigned index) {
    return fmt::format("wheels[{}].", index);
}

/// Every field that can be asked for.
std::vector<std::string> known_fields() {
    std::vector<std::string> fields{"road_friction"};
    const auto add = [&](const TypeTable* type, const std::string& prefix) {
        for (const RealField& number : real_fields(*type, prefix))
            if (std::find(fields.begin(), fields.end(), number.path) == fields.end())
                fields.push_back(number.path);
    };
    add(world::WeatherTypeTable(), "weather.");
    add(world::ControlTypeTable(), "");
    add(world::CarStateTypeTable(), "");
    add(world::WalkerStateTypeTable(), "");
    add(world::VehicleStateTypeTable(), "");
    for (unsigned wheel = 0; wheel < 4; ++wheel)
        add(world::WheelStateTypeTable(), wheel_prefix(wheel));
    add(world::MeasurementTypeTable(), "");
    return fields;
}

}  // namespace reprise::kernel

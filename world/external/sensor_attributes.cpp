#include "world/external/sensor_attributes.h"

#include <algorithm>

#include "world/check.h"

namespace reprise::world {

namespace {

constexpr AttributeRow rows[] = {
    {"own_car", is_camera, 0, 0, 1, "1: who carries the camera is in its pictures"},
};

}  // namespace

std::span<const AttributeRow> attribute_rows() {
    return rows;
}

const AttributeRow* find_attribute(SensorKind kind, std::string_view name) {
    for (const AttributeRow& row : rows)
        if (row.name == name && row.is_of(kind))
            return &row;
    return nullptr;
}

std::vector<std::string> attribute_names(SensorKind kind) {
    std::vector<std::string> names;
    for (const AttributeRow& row : rows)
        if (row.is_of(kind))
            names.emplace_back(row.name);
    return names;
}

double attribute(const SensorSpec& sensor, std::string_view name) {
    for (const AttributeValue& said : sensor.attributes)
        if (said.name == name)
            return said.value;
    const AttributeRow* row = find_attribute(sensor.kind, name);
    REPRISE_CHECK(row != nullptr, std::string(name));
    return row->usual;
}

bool are_possible(SensorKind kind, const std::vector<AttributeValue>& attributes) {
    for (auto one = attributes.begin(); one != attributes.end(); ++one) {
        const AttributeRow* row = find_attribute(kind, one->name);
        const bool again = std::any_of(attributes.begin(), one, [&](const AttributeValue& other) {
            return other.name == one->name;
        });
        if (row == nullptr || again || !(one->value >= row->low && one->value <= row->high))
            return false;
    }
    return true;
}

}  // namespace reprise::world

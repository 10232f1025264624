#include "cli/pictures/told.h"

#include <fmt/format.h>

#include "world/check.h"
#include "world/external/rig.h"
#include "world/external/sensor_attributes.h"
#include "world/story/wording.h"

namespace reprise::cli {

void tell(world::SensorSpec& sensor, std::span<const world::AttributeValue> said) {
    for (const world::AttributeValue& one : said)
        if (world::find_attribute(sensor.kind, one.name) != nullptr)
            sensor.attributes.push_back(one);
    if (!world::are_possible(sensor.kind, sensor.attributes))
        for (const world::AttributeValue& one : sensor.attributes) {
            const world::AttributeRow& row = *world::find_attribute(sensor.kind, one.name);
            throw world::Error(
                fmt::format("--attribute: {} of {} must be in [{:g}, {:g}] and said once, got {:g}",
                            one.name,
                            world::with_article(world::EnumNameSensorKind(sensor.kind)),
                            row.low,
                            row.high,
                            one.value));
        }
    if (const std::string why = world::contradiction(sensor); !why.empty())
        throw world::Error(
            fmt::format("{}: {}", sensor.attributes.empty() ? "--fov" : "--attribute", why));
}

}  // namespace reprise::cli

#include "render/ranging/point_frame.h"

#include <cstring>

namespace reprise::render {

world::SensorFrame point_frame(const world::TickView& tick,
                               const world::SensorSpec& spec,
                               std::span<const std::uint32_t> words) {
    const std::size_t columns = world::point_fields(spec.kind).size();
    world::SensorFrame frame;
    frame.name = spec.name;
    frame.kind = spec.kind;
    frame.tick = tick.index();
    frame.width = 1;
    frame.height = static_cast<int>(words.size() / columns);
    frame.channels = static_cast<int>(columns);
    frame.type = world::PixelType::f32;
    frame.data.resize(words.size_bytes());
    if (!words.empty())
        std::memcpy(frame.data.data(), words.data(), words.size_bytes());
    return frame;
}

}  // namespace reprise::render

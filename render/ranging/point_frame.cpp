#include "render/ranging/point_frame.h"

#include "world/external/point_fields.h"

namespace reprise::render {

world::SensorFrame point_frame(const world::TickView& tick,
                               const world::SensorSpec& spec,
                               std::span<const std::uint32_t> words) {
    const std::vector<std::uint32_t> one(words.begin(), words.end());
    return joined_point_frame(tick, spec, std::span(&one, 1));
}

world::SensorFrame joined_point_frame(const world::TickView& tick,
                                      const world::SensorSpec& spec,
                                      std::span<const std::vector<std::uint32_t>> pieces) {
    std::size_t bytes = 0;
    for (const std::vector<std::uint32_t>& words : pieces)
        bytes += words.size() * sizeof(std::uint32_t);
    const std::size_t columns = world::point_fields(spec.kind).size();
    world::SensorFrame frame;
    frame.name = spec.name;
    frame.kind = spec.kind;
    frame.tick = tick.index();
    frame.width = 1;
    frame.height = static_cast<int>(bytes / sizeof(std::uint32_t) / columns);
    frame.channels = static_cast<int>(columns);
    frame.type = world::PixelType::f32;
    frame.data.reserve(bytes);
    for (const std::vector<std::uint32_t>& words : pieces) {
        const auto* begin = reinterpret_cast<const std::uint8_t*>(words.data());
        frame.data.insert(frame.data.end(), begin, begin + words.size() * sizeof(std::uint32_t));
    }
    return frame;
}

}  // namespace reprise::render

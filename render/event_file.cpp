#include "render/event_file.h"

#include <cstring>

#include <fmt/format.h>

#include "files/output_file.h"

namespace reprise::render {

namespace {

std::string csv(const world::SensorFrame& frame) {
    std::string text = "x,y,t,pol\n";
    for (const world::PixelEvent& event : frame.events)
        text += fmt::format("{},{},{},{}\n", event.x, event.y, event.time_ns, event.rising ? 1 : 0);
    return text;
}

template <typename Value>
void put(std::vector<std::uint8_t>& bytes, const Value& value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof(Value));
    std::memcpy(bytes.data() + at, &value, sizeof(Value));
}

std::vector<std::uint8_t> npy(const world::SensorFrame& frame) {
    std::string header = fmt::format(
        "{{'descr': [('x', '<u2'), ('y', '<u2'), ('t', '<i8'), ('pol', '|b1')], "
        "'fortran_order': False, 'shape': ({},), }}",
        frame.events.size());
    // The format's own rule: with its ten bytes before it a multiple of 64.
    header.resize((header.size() + 1 + 10 + 63) / 64 * 64 - 10 - 1, ' ');
    header += '\n';
    std::vector<std::uint8_t> bytes{0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0};
    constexpr std::size_t of_event = 13;
    bytes.reserve(bytes.size() + 2 + header.size() + of_event * frame.events.size());
    put(bytes, static_cast<std::uint16_t>(header.size()));
    bytes.insert(bytes.end(), header.begin(), header.end());
    for (const world::PixelEvent& event : frame.events) {
        put(bytes, event.x);
        put(bytes, event.y);
        put(bytes, event.time_ns);
        put(bytes, static_cast<std::uint8_t>(event.rising ? 1 : 0));
    }
    return bytes;
}

}  // namespace

void write_events(const world::SensorFrame& frame, const std::filesystem::path& path) {
    if (path.extension() == ".csv")
        files::write_file(path, "the events", csv(frame));
    else
        files::write_file(path, "the events", npy(frame));
}

}  // namespace reprise::render

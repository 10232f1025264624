#include "remote/picture_ring.h"

#include <algorithm>

namespace reprise::remote {

namespace {

constexpr std::size_t cache_line = 64;  // [bytes]

}  // namespace

PictureRing::PictureRing(const world::Rig& rig, unsigned latency)
    : rig_(rig),
      places_(std::size_t{2} + latency) {
    for (const world::SensorSpec& sensor : rig.sensors) {
        const std::size_t size = world::frame_bytes(sensor);
        starts_.push_back(bytes_);
        strides_.push_back((size + cache_line - 1) / cache_line * cache_line);
        bytes_ += strides_.back() * places_;
    }
    bytes_ = std::max(bytes_, cache_line);  // of a rig of readings as well: no memory is none
}

std::vector<PlacedPicture> PictureRing::of(std::uint64_t tick) const {
    std::vector<PlacedPicture> pictures;
    for (const std::size_t sensor : rig_.due(tick)) {
        const std::size_t place =
            static_cast<std::size_t>(rig_.frames_before(sensor, tick)) % places_;
        pictures.push_back({static_cast<std::uint16_t>(sensor),
                            tick,
                            starts_[sensor] + place * strides_[sensor],
                            world::frame_bytes(rig_.sensors[sensor]),
                            {}});
    }
    return pictures;
}

}  // namespace reprise::remote

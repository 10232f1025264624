#include "replay/tick_bytes.h"

#include <algorithm>

namespace reprise::replay {

namespace {

/// Where the chain's bytes lie in the tick's.
std::size_t chain_at(const RecordedTick& tick) {
    const auto* chain = reinterpret_cast<const std::uint8_t*>(&tick.view.tick->digests()->chain());
    return static_cast<std::size_t>(chain - tick.tick_bytes.data());
}

}  // namespace

bool equal_ticks(const RecordedTick& expected, const RecordedTick& found) {
    return std::ranges::equal(expected.tick_bytes, found.tick_bytes) &&
           std::ranges::equal(expected.traffic_bytes, found.traffic_bytes);
}

bool equal_ticks_but_for_chain(const RecordedTick& expected, const RecordedTick& found) {
    const std::size_t at = chain_at(expected);
    if (at != chain_at(found) || expected.tick_bytes.size() != found.tick_bytes.size())
        return false;
    const std::size_t behind = at + sizeof(world::Digest128);
    return std::ranges::equal(expected.tick_bytes.first(at), found.tick_bytes.first(at)) &&
           std::ranges::equal(expected.tick_bytes.subspan(behind),
                              found.tick_bytes.subspan(behind)) &&
           std::ranges::equal(expected.traffic_bytes, found.traffic_bytes);
}

}  // namespace reprise::replay

#include "replay/compare/tick_bytes.h"

#include <algorithm>

#include "replay/level.h"

namespace reprise::replay {

namespace {

/// Where the chain's bytes lie in the tick's.
std::size_t chain_at(const RecordedTick& tick) {
    const auto* chain = reinterpret_cast<const std::uint8_t*>(&tick.view.tick->digests()->chain());
    return static_cast<std::size_t>(chain - tick.tick_bytes.data());
}

}  // namespace

CommonPart::CommonPart(const RecordedTick& expected_tick, const RecordedTick& found_tick)
    : expected(expected_tick),
      found(found_tick) {
    if (expected.view.traffic == nullptr || found.view.traffic == nullptr) {
        for (RecordedTick* tick : {&expected, &found}) {
            tick->view.traffic = nullptr;
            tick->traffic_bytes = {};
        }
    }
    const bool expected_is_less = is_inputs_only(*expected.view.tick);
    if (expected_is_less == is_inputs_only(*found.view.tick))
        return;
    const RecordedTick& less = expected_is_less ? expected : found;
    RecordedTick& more = expected_is_less ? found : expected;
    // Who is driven by hand is known from who has controls: the digests cover who should.
    std::vector<world::Control> controls;
    for (const world::Control& control : more.view.controls())
        if (world::find(less.view.controls(), control.actor()) != nullptr)
            controls.push_back(control);
    inputs_ = inputs_of(*more.view.tick, controls);
    more.tick_bytes = {inputs_.data(), inputs_.size()};
    more.view.tick = world::GetTick(inputs_.data());
}

bool equal_ticks(const RecordedTick& expected_tick, const RecordedTick& found_tick) {
    const CommonPart common(expected_tick, found_tick);
    const RecordedTick& expected = common.expected;
    const RecordedTick& found = common.found;
    return std::ranges::equal(expected.tick_bytes, found.tick_bytes) &&
           std::ranges::equal(expected.traffic_bytes, found.traffic_bytes);
}

bool equal_ticks_but_for_chain(const RecordedTick& expected_tick, const RecordedTick& found_tick) {
    const CommonPart common(expected_tick, found_tick);
    const RecordedTick& expected = common.expected;
    const RecordedTick& found = common.found;
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

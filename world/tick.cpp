#include "world/tick.h"

#include <algorithm>

#include "world/digest.h"
#include "world/random.h"

namespace reprise::world {

namespace {

template <typename T>
std::span<const T> structs(const flatbuffers::Vector<const T*>* vector) {
    if (vector == nullptr)
        return {};
    return {reinterpret_cast<const T*>(vector->Data()), vector->size()};
}

template <typename T, typename Id>
const T* find_sorted(std::span<const T> range, std::uint32_t id, Id id_of) {
    const auto found =
        std::lower_bound(range.begin(), range.end(), id, [&](const T& item, std::uint32_t wanted) {
            return id_of(item) < wanted;
        });
    return found != range.end() && id_of(*found) == id ? &*found : nullptr;
}

std::string joined(const std::string& text, const std::string& detail) {
    return detail.empty() ? text : text + ": " + detail;
}

}  // namespace

std::span<const VehicleState> TickView::vehicles() const {
    return structs(tick->vehicles());
}

std::span<const WheelState> TickView::wheels() const {
    return structs(tick->wheels());
}

std::span<const PropState> TickView::props() const {
    return structs(tick->props());
}

std::span<const Door> TickView::doors() const {
    return structs(tick->doors());
}

std::span<const Control> TickView::controls() const {
    return structs(tick->controls());
}

std::span<const Measurement> TickView::measurements() const {
    return structs(tick->measurements());
}

std::span<const SignalColor> TickView::signals() const {
    const auto* colors = tick->signals();
    if (colors == nullptr)
        return {};
    return {reinterpret_cast<const SignalColor*>(colors->Data()), colors->size()};
}

std::span<const CarState> TickView::cars() const {
    return structs(traffic->cars());
}

std::span<const WalkerState> TickView::walkers() const {
    return structs(traffic->walkers());
}

std::span<const Look> TickView::vehicle_looks() const {
    return structs(tick->looks());
}

std::span<const Look> TickView::car_looks() const {
    return structs(traffic->looks());
}

SealedTick seal(TickDraft& draft, const Digest128& previous) {
    Digests& digests = draft.tick.digests;
    const Digests stages = digests;
    Hasher hasher;
    hasher.add(draft.tick.index);
    for (const std::uint64_t stage : {stages.scenario(),
                                      stages.controls(),
                                      stages.traffic(),
                                      stages.pedestrians(),
                                      stages.physics(),
                                      stages.measurements()})
        hasher.add(stage);
    digests.mutable_state() = hasher.digest128();
    digests.mutable_chain() = chain(previous, digests.state());
    draft.traffic.tick = draft.tick.index;

    // ForceDefaults: a zero is written like any other value, so that sizes and bytes do not depend
    // on which values happen to equal a default (and -0.0 stays -0.0).
    flatbuffers::FlatBufferBuilder tick(4096);
    tick.ForceDefaults(true);
    FinishTickBuffer(tick, Tick::Pack(tick, &draft.tick));
    flatbuffers::FlatBufferBuilder traffic(
        1024 + draft.traffic.cars.size() * (sizeof(CarState) + sizeof(Look)) +
        draft.traffic.walkers.size() * sizeof(WalkerState));
    traffic.ForceDefaults(true);
    FinishTrafficBuffer(traffic, Traffic::Pack(traffic, &draft.traffic));
    return SealedTick(tick.Release(), traffic.Release());
}

const VehicleState* find(std::span<const VehicleState> vehicles, std::uint32_t id) {
    return find_sorted(vehicles, id, [](const VehicleState& item) { return item.id(); });
}

const CarState* find(std::span<const CarState> cars, std::uint32_t id) {
    return find_sorted(cars, id, [](const CarState& item) { return item.id(); });
}

const WalkerState* find(std::span<const WalkerState> walkers, std::uint32_t id) {
    return find_sorted(walkers, id, [](const WalkerState& item) { return item.id(); });
}

const Measurement* find(std::span<const Measurement> measurements, std::uint32_t actor) {
    return find_sorted(measurements, actor, [](const Measurement& item) { return item.actor(); });
}

const Control* find(std::span<const Control> controls, std::uint32_t actor) {
    return find_sorted(controls, actor, [](const Control& item) { return item.actor(); });
}

const Look* find(std::span<const Look> looks, std::uint32_t actor) {
    return find_sorted(looks, actor, [](const Look& item) { return item.actor(); });
}

const PropState* find(std::span<const PropState> props, std::uint32_t id) {
    return find_sorted(props, id, [](const PropState& item) { return item.id(); });
}

std::string to_line(const Event& event) {
    const auto text = [](const flatbuffers::String* string) {
        return string == nullptr ? std::string() : string->str();
    };
    return joined(text(event.text()), text(event.detail()));
}

bool tells_worst(const Event& event) {
    return event.kind() == EventKind::check_failed && event.detail() != nullptr &&
           event.detail()->string_view().starts_with(worst_prefix);
}

std::string to_line(const EventT& event) {
    return joined(event.text, event.detail);
}

Look drawn_look(std::uint64_t seed, std::uint32_t actor) {
    constexpr std::uint64_t looks = 0xffffffffu;
    return {actor,
            static_cast<std::uint32_t>(1 + draw_index(looks, seed, 0, Purpose::look, actor))};
}

}  // namespace reprise::world

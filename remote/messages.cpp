#include "remote/messages.h"

#include <algorithm>
#include <limits>

#include "remote/schema.h"

namespace reprise::remote {

namespace {

/// A table in a buffer of its own, as a vector of the message, aligned as its doubles want it.
flatbuffers::Offset<flatbuffers::Vector<std::uint8_t>> add(Packed& message,
                                                           std::span<const std::uint8_t> bytes) {
    message.ForceVectorAlignment(bytes.size(), 1, 16);
    return message.CreateVector(bytes.data(), bytes.size());
}

template <class Table, class Object>
Packed packed(const Object& object, const char* identifier) {
    Packed message;
    message.Finish(Table::Pack(message, &object), identifier);
    return message;
}

Packed pack_episode(const world::Recording& recording) {
    world::EpisodeT episode = recording.episode;
    episode.scenario.clear();  // a driver shall see the road, not the script
    return packed<world::Episode>(episode, world::EpisodeIdentifier());
}

template <class Struct>
void keep(std::span<const Struct> all, std::vector<Struct>& kept, auto&& is_own) {
    std::copy_if(all.begin(), all.end(), std::back_inserter(kept), is_own);
}

}  // namespace

std::span<const std::uint8_t> bytes_of(const Packed& message) {
    return {message.GetBufferPointer(), message.GetSize()};
}

Packed pack_hello(const Greeting& greeting, const world::Recording& recording) {
    Packed message;
    const auto schema = message.CreateString(schema_digest());
    const auto name = message.CreateString(greeting.name);
    const auto episode = add(message, bytes_of(pack_episode(recording)));
    const auto town =
        add(message, bytes_of(packed<world::Town>(recording.town, world::TownIdentifier())));
    flatbuffers::Offset<flatbuffers::Vector<std::uint8_t>> spawn;
    if (greeting.spawn != nullptr)
        spawn = add(message, bytes_of(packed<world::Command>(*greeting.spawn, nullptr)));
    flatbuffers::Offset<flatbuffers::Vector<std::uint8_t>> route;
    if (greeting.route != nullptr)
        route = add(message, bytes_of(packed<world::Command>(*greeting.route, nullptr)));
    flatbuffers::Offset<flatbuffers::String> network;
    if (greeting.with_network)
        network = message.CreateString(recording.network);
    message.Finish(CreateHello(message,
                               wire_version,
                               schema,
                               greeting.actor,
                               name,
                               recording.episode.step_ns,
                               episode,
                               town,
                               spawn,
                               greeting.shared_bytes,
                               route,
                               network));
    return message;
}

Packed pack_observation(std::span<const std::uint8_t> tick,
                        std::span<const std::uint8_t> traffic,
                        std::span<const PlacedPicture> pictures,
                        const std::uint8_t* memory,
                        const Guidance& guidance,
                        std::span<const std::vector<std::uint8_t>> passed) {
    using Bytes = flatbuffers::Offset<flatbuffers::Vector<std::uint8_t>>;
    Packed message(tick.size() + traffic.size() + 256);
    std::vector<flatbuffers::Offset<Picture>> placed;
    for (const PlacedPicture& picture : pictures) {
        Bytes data;
        if (!picture.reading.empty())
            data = add(message, picture.reading);
        else if (memory != nullptr)
            data = add(message, {memory + picture.offset, picture.size});
        placed.push_back(CreatePicture(
            message, picture.sensor, picture.tick, picture.offset, data, picture.size));
    }
    const auto of_pictures =
        placed.empty() ? flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<Picture>>>()
                       : message.CreateVector(placed);
    std::vector<flatbuffers::Offset<PassedTick>> gone;
    for (const std::vector<std::uint8_t>& one : passed)
        gone.push_back(CreatePassedTick(message, add(message, one)));
    const auto of_passed =
        gone.empty() ? flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<PassedTick>>>()
                     : message.CreateVector(gone);
    const Bytes of_traffic = traffic.empty() ? Bytes() : add(message, traffic);
    const Bytes of_tick = tick.empty() ? Bytes() : add(message, tick);
    message.Finish(CreateObservation(message,
                                     of_tick,
                                     of_traffic,
                                     of_pictures,
                                     guidance.turning,
                                     guidance.way_to_goal,
                                     of_passed));
    return message;
}

std::vector<std::uint8_t> own_tick(const world::TickView& tick, std::uint32_t actor) {
    world::TickT own;
    own.index = tick.index();
    keep(tick.controls(), own.controls, [&](const auto& one) { return one.actor() == actor; });
    keep(tick.vehicles(), own.vehicles, [&](const auto& one) { return one.id() == actor; });
    keep(tick.wheels(), own.wheels, [&](const auto& one) { return one.vehicle() == actor; });
    keep(tick.measurements(), own.measurements, [&](const auto& one) {
        return one.actor() == actor;
    });
    for (world::Measurement& measured : own.measurements)
        measured.mutate_gap_ahead(std::numeric_limits<double>::quiet_NaN());
    const Packed message = packed<world::Tick>(own, world::TickIdentifier());
    const auto bytes = bytes_of(message);
    return {bytes.begin(), bytes.end()};
}

}  // namespace reprise::remote

#include "replay/level.h"

#include <array>

#include <fmt/format.h>

#include "world/check.h"

namespace reprise::replay {

namespace {

constexpr std::uint64_t key_interval = 20;  // [ticks] a second of the usual step
constexpr std::array words{"inputs", "core", "keyed", "full"};  // as Level counts

}  // namespace

const char* to_word(Level level) {
    return words.at(static_cast<std::size_t>(level));
}

std::optional<Level> level_named(std::string_view word) {
    for (std::size_t i = 0; i < words.size(); ++i)
        if (word == words[i])
            return static_cast<Level>(i);
    return std::nullopt;
}

bool holds_traffic(Level level, std::uint64_t tick) {
    return level == Level::full || (level == Level::keyed && tick % key_interval == 1);
}

std::uint64_t traffic_ticks(Level level, std::uint64_t ticks) {
    if (level == Level::full)
        return ticks;
    return level == Level::keyed ? (ticks + key_interval - 1) / key_interval : 0;
}

std::string lacks_text(const std::string& trace, Level level) {
    const char* what = level == Level::inputs ? "inputs only"
                       : level == Level::core ? "no traffic"
                                              : "traffic in ticks 1, 21, 41, ... only";
    return fmt::format(
        "{} holds {}; `reprise expand {} -o FULL.mcap` makes the rest again", trace, what, trace);
}

bool is_inputs_only(const world::Tick& tick) {
    return tick.weather() == nullptr;
}

flatbuffers::DetachedBuffer inputs_of(const world::Tick& tick,
                                      const std::vector<world::Control>& controls) {
    flatbuffers::FlatBufferBuilder builder(256);
    flatbuffers::Offset<flatbuffers::Vector<const world::Control*>> vector;
    if (!controls.empty())
        vector = builder.CreateVectorOfStructs(controls);
    world::TickBuilder reduced(builder);
    reduced.add_index(tick.index());
    reduced.add_digests(tick.digests());
    if (!controls.empty())
        reduced.add_controls(vector);
    world::FinishTickBuffer(builder, reduced.Finish());
    return builder.Release();
}

void Reduction::note_drivers(const world::Tick& tick) {
    for (const world::Command* command : *tick.commands()) {
        if (command->kind() == world::CommandKind::spawn &&
            world::takes_controls(command->driver()))
            by_hand_.insert(command->actor());
        if (command->kind() == world::CommandKind::despawn)
            by_hand_.erase(command->actor());
    }
}

RecordedTick Reduction::of(const RecordedTick& tick) {
    RecordedTick reduced = tick;
    const std::uint64_t index = tick.view.index();
    if (!holds_traffic(level_, index)) {
        reduced.view.traffic = nullptr;
        reduced.traffic_bytes = {};
    }
    REPRISE_CHECK(holds_traffic(level_, index) == !reduced.traffic_bytes.empty(),
                  fmt::format("tick {} lacks its traffic", index));
    if (level_ != Level::inputs || is_inputs_only(*tick.view.tick)) {
        REPRISE_CHECK(level_ == Level::inputs || !is_inputs_only(*tick.view.tick),
                      fmt::format("of tick {} there are inputs only", index));
        return reduced;
    }
    note_drivers(*tick.view.tick);
    std::vector<world::Control> controls;
    for (const world::Control& control : tick.view.controls())
        if (by_hand_.count(control.actor()) != 0)
            controls.push_back(control);
    inputs_ = inputs_of(*tick.view.tick, controls);
    reduced.tick_bytes = {inputs_.data(), inputs_.size()};
    reduced.view.tick = world::GetTick(inputs_.data());
    return reduced;
}

}  // namespace reprise::replay

#include "exchange/page/page_story.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

namespace reprise::exchange {

namespace {

using nlohmann::json;

std::string text_or_empty(const flatbuffers::String* text) {
    return text == nullptr ? "" : text->str();
}

/// Who touches whom, either way round. `minmax` of two temporaries would refer to nothing.
std::pair<std::uint32_t, std::uint32_t> pair_of(const world::Event& event) {
    return {std::min(event.actor(), event.other()), std::max(event.actor(), event.other())};
}

}  // namespace

void PageStory::learn(const world::Tick& tick) {
    if (tick.commands() != nullptr)
        for (const world::Command* command : *tick.commands()) {
            if (command->kind() == world::CommandKind::spawn)
                drivers_[command->actor()] = command->driver();
            if (command->kind() == world::CommandKind::set_weather)
                weather_name_ = text_or_empty(command->text());
        }
    if (tick.events() != nullptr)
        for (const world::Event* event : *tick.events())
            if (event->kind() == world::EventKind::spawned && event->text() != nullptr &&
                (event->actor() < world::first_background_id || all_named_))
                names_[event->actor()] = event->text()->str();
}

void PageStory::hear(const world::Tick& tick) {
    learn(tick);
    hear_weather(tick);
    hear_signals(tick);
    if (tick.events() != nullptr)
        for (const world::Event* event : *tick.events())
            hear_event(*event, tick.index());
}

/// Background cars come and go all the time.
bool PageStory::is_worth_telling(const world::Event& event) const {
    const bool comes_or_goes =
        event.kind() == world::EventKind::spawned || event.kind() == world::EventKind::despawned;
    return !comes_or_goes || event.actor() < world::first_background_id;
}

void PageStory::hear_event(const world::Event& event, std::uint64_t tick) {
    if (!is_worth_telling(event) || hear_worst(event) || goes_on(event, tick) ||
        hear_end_of_collision(event, tick))
        return;
    Happening heard;
    heard.tick = heard.end = tick;
    heard.kind = event.kind();
    heard.actor = event.actor();
    heard.other = event.other();
    heard.value = event.value();
    heard.line = event.line();
    heard.text = world::to_line(event);
    heard.located = event.position() != nullptr && (event.kind() == world::EventKind::collision ||
                                                    event.kind() == world::EventKind::blocked);
    if (heard.located)
        heard.position = *event.position();
    happenings_.push_back(heard);
}

/// What tells how bad a failed check became belongs to the failure, where that was heard.
bool PageStory::hear_worst(const world::Event& event) {
    if (!world::tells_worst(event))
        return false;
    const auto failed = std::find_if(happenings_.begin(), happenings_.end(), [&](const auto& one) {
        return one.kind == world::EventKind::check_failed &&
               one.text.starts_with(event.text()->str());
    });
    if (failed == happenings_.end())
        return false;
    failed->worst = event.detail()->str();
    return true;
}

/// Two that touch do so in many ticks: one crash.
bool PageStory::goes_on(const world::Event& event, std::uint64_t tick) {
    if (event.kind() != world::EventKind::collision)
        return false;
    constexpr std::uint64_t apart = 20;  // [ticks]
    const auto [found, is_new] = collisions_.try_emplace(pair_of(event), happenings_.size());
    if (is_new || tick > happenings_[found->second].end + apart) {
        found->second = happenings_.size();
        return false;
    }
    happenings_[found->second].end = tick;
    happenings_[found->second].value = std::max(happenings_[found->second].value, event.value());
    return true;
}

/// Of one that began behind the page's first tick, or it is told as what it is.
bool PageStory::hear_end_of_collision(const world::Event& event, std::uint64_t tick) {
    if (event.kind() != world::EventKind::collision_ended)
        return false;
    const auto found = collisions_.find(pair_of(event));
    if (found == collisions_.end())
        return false;
    Happening& crash = happenings_[found->second];
    crash.end = tick;
    crash.value = std::max(crash.value, event.value());
    return true;
}

void PageStory::hear_weather(const world::Tick& tick) {
    if (tick.weather() == nullptr)
        return;
    const bool changes =
        tick.commands() != nullptr &&
        std::any_of(tick.commands()->begin(), tick.commands()->end(), [](const auto* command) {
            return command->kind() == world::CommandKind::set_weather;
        });
    if (!weathers_.empty() && !changes)
        return;
    constexpr double degrees = 180 / std::numbers::pi;
    weathers_.push_back({{"tick", tick.index()},
                         {"name", weather_name_},
                         {"sun", double{tick.weather()->sun_altitude()} * degrees},
                         {"rain", tick.weather()->rain()},
                         {"friction", tick.road_friction()}});
}

void PageStory::hear_signals(const world::Tick& tick) {
    const auto* const colours = tick.signals();
    if (colours == nullptr)
        return;
    colours_.resize(colours->size(), world::SignalColor::off);
    for (std::uint32_t i = 0; i < colours->size(); ++i) {
        const auto colour = static_cast<world::SignalColor>(colours->Get(i));
        if (colours_[i] != colour)
            signals_.push_back({tick.index(), i, static_cast<int>(colour)});
        colours_[i] = colour;
    }
}

std::string PageStory::name_of(std::uint32_t actor) const {
    if (actor == 0)
        return "something fixed";
    const auto named = names_.find(actor);
    return named == names_.end() ? fmt::format("actor {}", actor) : named->second;
}

std::string PageStory::text_of(const Happening& happening) const {
    switch (happening.kind) {
        case world::EventKind::spawned:
            return name_of(happening.actor) + " appears";
        case world::EventKind::despawned:
            return name_of(happening.actor) + " leaves";
        case world::EventKind::collision:
        case world::EventKind::collision_ended:
            return fmt::format("{} hits {}",
                               name_of(happening.actor),
                               name_of(happening.other)) +
                   (happening.value < 0.5 ? ""  // imported: nobody measured it
                                          : fmt::format(", {:.0f} N s", happening.value));
        case world::EventKind::ran_red_light:
        case world::EventKind::ran_stop_sign:
        case world::EventKind::on_opposite_lane:
        case world::EventKind::on_sidewalk:
        case world::EventKind::left_road:
        case world::EventKind::speeding:
        case world::EventKind::wrong_way:
        case world::EventKind::wrecked:
        case world::EventKind::backed_off:
            return name_of(happening.actor) + " " + happening.text;
        case world::EventKind::overtakes:
            return fmt::format("{} overtakes {} {}",
                               name_of(happening.actor),
                               name_of(happening.other),
                               happening.text);
        case world::EventKind::blocked:
            return fmt::format("{} is blocked {}", name_of(happening.actor), happening.text);
        default:
            return happening.text;
    }
}

void PageStory::write(json& head) const {
    head["names"] = json::object();
    for (const auto& [actor, name] : names_)
        head["names"][std::to_string(actor)] = name;
    head["drivers"] = json::object();
    for (const auto& [actor, driver] : drivers_)
        head["drivers"][std::to_string(actor)] = world::EnumNameDriver(driver);
    head["weathers"] = weathers_;
    head["signals"] = signals_;
    head["events"] = json::array();
    for (const Happening& happening : happenings_) {
        json event = {{"tick", happening.tick},
                      {"kind", world::EnumNameEventKind(happening.kind)},
                      {"text", text_of(happening)}};
        if (happening.end > happening.tick)
            event["end"] = happening.end;
        if (happening.actor != 0)
            event["actor"] = happening.actor;
        if (happening.other != 0)
            event["other"] = happening.other;
        if (happening.located)
            event["at"] = {happening.position.x(), happening.position.y()};
        if (happening.line != 0)
            event["line"] = happening.line;
        if (!happening.worst.empty())
            event["worst"] = happening.worst;
        head["events"].push_back(event);
    }
}

}  // namespace reprise::exchange

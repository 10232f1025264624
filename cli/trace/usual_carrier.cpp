#include "cli/trace/usual_carrier.h"

#include <charconv>

namespace reprise::cli {

namespace {

std::optional<std::uint32_t> hero_of(const world::EpisodeT& episode) {
    for (const world::ParameterT& parameter : episode.parameters) {
        std::uint32_t id = 0;
        const char* end = parameter.value.data() + parameter.value.size();
        if (parameter.key == "hero" && std::from_chars(parameter.value.data(), end, id) ==
                                           std::from_chars_result{end, std::errc()})
            return id;
    }
    return std::nullopt;
}

}  // namespace

UsualCarrier::UsualCarrier(const world::EpisodeT& episode)
    : imported_(!episode.imported_from.empty()) {
    if (imported_)
        hero_ = hero_of(episode);
}

std::optional<std::uint32_t> UsualCarrier::in(const world::TickView& tick) const {
    if (imported_)
        return hero_ && world::find(tick.cars(), *hero_) != nullptr ? hero_ : std::nullopt;
    return tick.vehicles().empty() ? std::nullopt : std::optional(tick.vehicles().front().id());
}

}  // namespace reprise::cli

#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace reprise::towns {

/// The signals and signs that a town can show.
enum class SignalKind : std::uint8_t { light, stop, yield, speed_limit };

/// What an OpenDRIVE signal says of itself, as written in the map.
struct SignalWords {
    std::string_view type, subtype, value, unit, name, country;
    bool dynamic = false;
};

/// What it is: by its type; by its name where the type says nothing that is known here. Nothing for
/// what has no place in a town.
std::optional<SignalKind> kind_of(const SignalWords& signal);

/// The limit that it shows. [km/h]; 0 when it does not say, or is no limit.
double limit_kmh(const SignalWords& signal);

}  // namespace reprise::towns

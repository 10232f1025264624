#include "towns/maps/signal_words.h"

#include <algorithm>
#include <array>
#include <regex>
#include <string>
#include <utility>

#include "towns/network/network_xml.h"

namespace reprise::towns {

namespace {

using Kind = SignalKind;

std::string lower(std::string_view text) {
    std::string lowered(text);
    std::transform(lowered.begin(), lowered.end(), lowered.begin(), [](unsigned char c) {
        return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    return lowered;
}

bool contains(std::string_view name, std::string_view word) {
    return lower(name).find(word) != std::string::npos;
}

/// The number in a name that has the form of a limit, such as Speed_30 or Sign_SpeedLimit_30; 0 for
/// all others, such as SpeedBump_5 or EndOfSpeedLimit50.
double limit_in(std::string_view name) {
    constexpr std::size_t longest = 40;
    static const std::regex form(
        "(?:sign|max|maximum|[ _-])*speed(?:limit|sign|[ _-])*([0-9]{1,3})[ _-]?(?:mph|kmh|kph)?");
    const std::string lowered = lower(name);
    std::smatch parts;
    return name.size() <= longest && std::regex_match(lowered, parts, form)
               ? number(parts[1].str(), 0)
               : 0;
}

/// Types of the German catalogue (VzKat), which OpenDRIVE's examples and CARLA use in every
/// country, and of the US's (MUTCD). Those without a kind are no limits, whatever their name has in
/// it.
constexpr std::array<std::pair<std::string_view, std::optional<Kind>>, 14> catalogue{{
    {"206", Kind::stop},
    {"R1-1", Kind::stop},
    {"205", Kind::yield},
    {"R1-2", Kind::yield},
    {"274", Kind::speed_limit},
    {"274.1", Kind::speed_limit},  // of a zone
    {"R2-1", Kind::speed_limit},
    {"274.2", std::nullopt},  // the end of a zone
    {"275", std::nullopt},    // lowest speed
    {"278", std::nullopt},    // the end of a limit
    {"279", std::nullopt},
    {"282", std::nullopt},
    {"R2-4", std::nullopt},   // lowest speed
    {"W13-1", std::nullopt},  // advice
}};

bool in_miles(const SignalWords& signal) {
    const std::string_view unit = signal.unit, country = signal.country;
    return unit == "mph" ||
           (unit.empty() && (country == "US" || country == "USA" || contains(signal.name, "mph")));
}

/// [km/h] of a German sign 274-30 or 274.1-20; 0 when its subtype says nothing. Before 2017,
/// 274-51 was the sign for 10 km/h, 274-52 that for 20 km/h and so on up to 274-63.
double german_limit(const SignalWords& signal) {
    const double subtype = signal.type.starts_with("274") ? number(signal.subtype, 0) : 0;
    const bool is_old = subtype > 50 && subtype <= 63 && subtype != 60 && !in_miles(signal);
    return is_old ? 10 * (subtype - 50) : subtype;
}

}  // namespace

std::optional<SignalKind> kind_of(const SignalWords& signal) {
    const std::string_view type = signal.type, name = signal.name;
    if (signal.dynamic)
        return type.starts_with("10000") || contains(name, "light") || contains(name, "signal")
                   ? std::optional(Kind::light)
                   : std::nullopt;
    for (const auto& [known, kind] : catalogue)
        if (type == known)
            return kind;
    if (contains(name, "stop_sign") || name == "Sign_Stop")
        return Kind::stop;
    if (contains(name, "yield"))
        return Kind::yield;
    return limit_in(name) > 0 ? std::optional(Kind::speed_limit) : std::nullopt;
}

double limit_kmh(const SignalWords& signal) {
    double limit = number(signal.value, 0);
    if (limit <= 0)
        limit = german_limit(signal);
    if (limit <= 0)
        limit = limit_in(signal.name);
    const double factor = in_miles(signal) ? 1.609344 : signal.unit == "m/s" ? 3.6 : 1;
    return limit > 0 && limit * factor < 300 ? limit * factor : 0;
}

}  // namespace reprise::towns

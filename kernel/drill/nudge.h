#pragma once

#include <cstdint>
#include <string>

namespace reprise::kernel {

/// A drill: one number of one tick is moved by some units in the last place, without a word in the
/// recording, so that one can see what verify and diff say about it.
struct Nudge {
    std::string text;  ///< as it was asked for, for messages
    std::uint64_t tick = 0;
    std::string actor;       ///< name or id; empty: the first one that has the field
    std::string field;       ///< such as steer, velocity.x, wheels[2].rotation, weather.rain
    std::int64_t units = 0;  ///< upwards; 0: one, towards zero from above and upwards else
};

/// Reads TICK[:[ACTOR.]FIELD[:UNITS]]; without a field it is the steering of the first vehicle.
/// Throws world::Error in one line, with the nearest field there is.
Nudge parse_nudge(const std::string& text);

/// `value` moved along the numbers of its type, denormal ones among them; both zeros are one place.
/// Throws world::Error beyond the largest number.
double moved_by_units(double value, std::int64_t units);

}  // namespace reprise::kernel

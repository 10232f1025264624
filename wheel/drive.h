#pragma once

#include "remote/client.h"
#include "wheel/view.h"

namespace reprise::wheel {

/// The keys, for people.
extern const char* const keys_text;

/// A person drives until the run or she ends it. `pace`: simulated over real time, 0: as fast as it
/// goes. Throws world::Error when the run is gone without a word.
void drive(remote::Client& run, View& view, const Clock& clock, double pace);

}  // namespace reprise::wheel

#pragma once

#include "replay/compare/divergence.h"

namespace reprise::cli {

/// The fingerprint of the program that runs, as an episode records it.
replay::Fingerprint this_build();

}  // namespace reprise::cli

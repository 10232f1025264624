#pragma once

#include <cstdint>

#include "towns/check/criterion.h"
#include "towns/network/network.h"

namespace reprise::cli {

/// Drives there for a minute, among so many cars (100 at most), in programs of their own
/// (reprise-run): SUMO ends the one that it is in where a network asks too much of it. No drive may
/// end before its time; those that do say why.
towns::Criterion check_driving(const towns::Network& network, std::uint32_t cars);

}  // namespace reprise::cli

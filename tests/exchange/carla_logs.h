#pragma once

#include <string>

#include "exchange/carla/carla_log.h"

namespace reprise::test {

/// A recording that make_carla_log.py writes with these options, as bytes.
std::string carla_log(const std::string& options);

/// Bytes in memory as a log.
exchange::CarlaBytes bytes_of(const std::string& log);

}  // namespace reprise::test

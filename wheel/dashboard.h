#pragma once

#include <optional>
#include <string>

#include "remote/client.h"

namespace reprise::wheel {

/// What is told beside the picture.
struct Dashboard {
    double speed = 0;  ///< [m/s] along the vehicle's x axis
    bool reverse = false;
    std::optional<double> limit{};  ///< [m/s] of the lane; none off every lane
    std::optional<double> gap{};    ///< [m] to who is ahead; none: free, or not told
    remote::Client::Way way{};
    double time = 0;    ///< [s] simulated
    double factor = 0;  ///< simulated over real time
    bool paused = false;
};

/// One line, such as "47 km/h  D  limit 50  gap 23 m  left, goal 340 m  0:12  1.00 x real time".
std::string to_line(const Dashboard& told);

}  // namespace reprise::wheel

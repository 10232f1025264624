#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "traffic/cars/cars.h"
#include "traffic/sight/foresight.h"

namespace reprise::traffic {

/// One of the cars, for the tick in which Meetings looks at it. Private to Meetings and its parts.
struct MetDriver {
    /// What decides about a car beside its pose.
    struct Manner {
        std::uint32_t standing_ticks = 0;
        std::uint32_t stuck_ticks = 0;
        std::uint64_t pushes_until = 0;          ///< tick
        std::vector<std::uint32_t> pushes_past;  ///< ids
        std::vector<std::uint32_t> waits_for;    ///< ids, of the last look

        bool is_of(const Car& car) const;
        void take(const Car& car);
    };

    const Car* car = nullptr;  ///< null of one who takes no part
    double reach = 0;          ///< [m] of way that is looked at
    double half_length = 0;    ///< [m]
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    Foresight* seen = nullptr;               ///< once it is asked for
    std::vector<std::uint32_t> waits_for;    ///< ids, of this tick
    std::vector<std::uint32_t> blocked_by;   ///< likewise
    std::uint64_t pushes_until = 0;          ///< tick
    std::vector<std::uint32_t> pushes_past;  ///< ids
    double leans = 0;                        ///< [m] left, for whom it pushes past from now on
    Manner manner;                           ///< with which it came

    static bool takes_part(const Car& car);

    /// Begins the tick with this one, as it is now.
    void take(const Car& of);
};

}  // namespace reprise::traffic

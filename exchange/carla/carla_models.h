#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "exchange/carla/carla_frame.h"

namespace reprise::exchange {

/// The model of ours that stands in for one of CARLA's.
struct CarlaModel {
    std::uint16_t model = 0;  ///< index in the catalogue of its kind
    std::string guessed_by;   ///< what it was chosen by; empty: the blueprint is known
};

/// By the blueprint's name, or by the recorded box, or by what its attributes say.
CarlaModel vehicle_model_for(const CarlaActor& vehicle, const std::optional<CarlaBox>& box);

/// One of those that fit in age and gender, as attributes or the blueprint's number say: the same
/// for all of a blueprint, another for most others.
CarlaModel walker_model_for(const CarlaActor& walker);

}  // namespace reprise::exchange

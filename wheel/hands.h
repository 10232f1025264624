#pragma once

#include "remote/client.h"
#include "wheel/view.h"
#include "world/models/catalogue.h"

namespace reprise::wheel {

/// Makes of keys, which are down or up, what hands and feet would do: the wheel turns and comes
/// back in its time, less far the faster one goes, and pedals go down in a moment.
class Hands {
  public:
    explicit Hands(const world::VehicleModel& model) : model_(&model) {}

    /// For the next `step` [s] of simulated time. `speed`: [m/s] along the vehicle's x axis.
    remote::Client::Wheel advance(const Wishes& wishes, double speed, double step);

    /// Whether the gear is in reverse. It is changed when the vehicle stands, or nearly.
    bool in_reverse() const { return reverse_; }

  private:
    double steering_limit(double speed) const;

    const world::VehicleModel* model_;
    bool reverse_ = false;
    double steer_ = 0;     ///< [-1, 1], left positive
    double throttle_ = 0;  ///< [0, 1]
    double brake_ = 0;     ///< [0, 1]
};

}  // namespace reprise::wheel

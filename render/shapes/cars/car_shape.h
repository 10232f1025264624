#pragma once

#include <vector>

#include "render/shapes/mesh.h"
#include "world/models/catalogue.h"

namespace reprise::render {

/// The outer lines of a vehicle model, from which its mesh is lofted and its windows and lamps are
/// laid out. Frame of the vehicle: x ahead from the rear axle, y left, z up from the ground. [m]
struct CarShape {
    explicit CarShape(const world::VehicleModel& of);

    float top(float x) const;         ///< outline of hood, windows and roof, in the middle
    float belt(float x) const;        ///< where the sides end and windows or the hood begin
    float half_width(float x) const;  ///< widest, seen from above

    const world::VehicleModel* model;
    world::BodyStyle style;
    float rear;         ///< x of the rear bumper
    float front;        ///< x of the front bumper
    float body_rear;    ///< x where the lofted body starts: a lorry's cab, else `rear`
    float sill;         ///< ground clearance
    float tumble_home;  ///< how much the windows lean in [m per m of height]
    float boxiness;     ///< 0: round roof edges, 1: sharp ones

    float length() const { return front - rear; }

    float height() const { return static_cast<float>(model->height); }

    float wheel_radius() const { return static_cast<float>(model->wheel_radius); }

    float wheelbase() const { return static_cast<float>(model->wheelbase); }

    /// Share of the length, 0 at the rear bumper.
    float along(float x) const { return (x - rear) / length(); }
};

/// Body without wheels, in the vehicle's frame. 3,000 to 5,000 triangles.
Mesh car_body_mesh(const CarShape& shape);

/// A wheel around its own y axis, outer side at +y.
Mesh wheel_mesh(const CarShape& shape);

}  // namespace reprise::render

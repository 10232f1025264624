#pragma once

#include <string>
#include <vector>

#include "world/external/sensor.h"

namespace reprise::cli {

/// `boxes` is what box_text says of a picture, see docs/rendering.md.

/// A label file of KITTI's: a line for each of them.
std::string kitti_labels(const std::string& boxes, const world::SensorSpec& camera);

/// COCO's annotations of a picture, without their ids and that of the picture. `instances`: what
/// the masks are made of.
std::string coco_annotations(const std::string& boxes, const world::SensorFrame& instances);

/// Which share of an actor a picture shows: its pixels, and how many such a thing has there when
/// nothing hides it. Of one of "boxes".
double shown_share(const std::string& box);

/// COCO's categories, as JSON: CARLA's tags of all that moves.
std::string coco_categories();

}  // namespace reprise::cli

#pragma once

#include <cstdint>
#include <filesystem>

#include "world/external/sensor.h"

namespace reprise::render {

/// What is in a picture, for how it is packed best.
enum class Texture : std::uint8_t {
    grainy,  ///< as rgb frames, whose noise repeats nothing
    flat     ///< drawn: areas of one colour
};

/// How a depth stands in a PNG. The sky, and what is farther than a coding reaches, is the largest
/// value; but of kitti 0, which there means that nothing was measured.
enum class DepthCoding : std::uint8_t {
    centimetres,  ///< 16-bit grey, up to 655.34 m
    millimetres,  ///< 16-bit grey, up to 65.534 m
    kitti,        ///< 16-bit grey, 1/256 m, up to 255.99 m
    carla         ///< 8-bit colour: (R + 256 G + 65536 B) / (2^24 - 1) of a kilometre
};

/// Writes a frame as PNG. rgb: 8-bit colour. depth: as `coding` says. semantic: 8-bit grey, class
/// ids. instance: 16-bit grey. flow: as KITTI, 16-bit colour: R = 64 x + 32768, G = 64 y + 32768,
/// B = 1, all 0 where it is unknown or beyond 511 px. normals: 16-bit colour, x, y and z as
/// (n + 1) * 32767.5, all 0 where there is none. `texture` is of colours. Throws world::Error when
/// it cannot be written. An rgb frame of 800x600: 20 ms.
void write_png(const world::SensorFrame& frame,
               const std::filesystem::path& path,
               Texture texture = Texture::grainy,
               DepthCoding coding = DepthCoding::centimetres);

/// Writes the frame's numbers as they are as an array of numpy, (height, width) or (height, width,
/// channels).
void write_npy(const world::SensorFrame& frame, const std::filesystem::path& path);

/// Writes a frame of floats as OpenEXR of 32-bit floats, ZIP packed: depth as Y, normals as R, G,
/// B, flow as R, G and 1 in B where it is known, all 0 where it is not.
void write_exr(const world::SensorFrame& frame, const std::filesystem::path& path);

/// The classes of a semantic frame as the twelve of CARLA's paper (CoRL 2017) and of its releases
/// before 0.9.14: 0 unlabeled, 1 building, 2 fence, 3 other, 4 pedestrian, 5 pole, 6 road line, 7
/// road, 8 sidewalk, 9 vegetation, 10 car, 11 wall, 12 traffic sign.
world::SensorFrame in_paper_classes(const world::SensorFrame& frame);

/// A version for people: depth near-bright on a logarithmic scale, semantic in CityScapes colours;
/// instances in colours of their own; flow and normals as colours around grey; rgb as it is.
world::SensorFrame viewable(const world::SensorFrame& frame);

}  // namespace reprise::render

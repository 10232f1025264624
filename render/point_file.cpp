#include "render/point_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "files/output_file.h"

namespace reprise::render {

namespace {

using world::PointField;

struct Points {
    std::vector<PointField> fields;
    std::vector<std::uint32_t> words;  ///< as they lie in files
    std::size_t count = 0;
};

float real(std::uint32_t word) {
    return std::bit_cast<float>(word);
}

/// A radar's detections with their places: what viewers look for.
Points points_of(const world::SensorFrame& frame) {
    const auto fields = world::point_fields(frame.kind);
    Points points{{fields.begin(), fields.end()}, {}, static_cast<std::size_t>(frame.height)};
    points.words.resize(frame.data.size() / sizeof(std::uint32_t));
    if (!frame.data.empty())
        std::memcpy(points.words.data(), frame.data.data(), frame.data.size());
    if (frame.kind != world::SensorKind::radar)
        return points;
    std::vector<std::uint32_t> placed;
    for (std::size_t i = 0; i < points.count; ++i) {
        const std::uint32_t* row = points.words.data() + i * fields.size();
        const double azimuth = static_cast<double>(real(row[1]));
        const double altitude = static_cast<double>(real(row[2]));
        const double depth = static_cast<double>(real(row[3]));
        for (const double place : {depth * std::cos(altitude) * std::cos(azimuth),
                                   depth * std::cos(altitude) * std::sin(azimuth),
                                   depth * std::sin(altitude)})
            placed.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(place)));
        placed.insert(placed.end(), row, row + fields.size());
    }
    points.words = std::move(placed);
    points.fields.insert(points.fields.begin(),
                         {{"x", false, "[m]"}, {"y", false, "[m]"}, {"z", false, "[m]"}});
    return points;
}

std::string bytes_of(const std::vector<std::uint32_t>& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::uint32_t)};
}

std::string ply_header(const Points& points, const world::SensorFrame& frame) {
    std::string header = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment {} '{}' at tick {}\nelement vertex {}\n",
        world::EnumNameSensorKind(frame.kind),
        frame.name,
        frame.tick,
        points.count);
    for (const PointField& field : points.fields)
        header += fmt::format("property {} {}\n", field.whole ? "uint" : "float", field.name);
    return header + "end_header\n";
}

std::string pcd_header(const Points& points) {
    std::string names, sizes, types, counts;
    for (const PointField& field : points.fields) {
        names += fmt::format(" {}", field.name);
        sizes += " 4";
        types += field.whole ? " U" : " F";
        counts += " 1";
    }
    return fmt::format(
        "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS{}\nSIZE{}\nTYPE{}\n"
        "COUNT{}\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
        names,
        sizes,
        types,
        counts,
        points.count,
        points.count);
}

std::string kitti_bytes(const Points& points) {
    std::vector<std::uint32_t> words;
    const std::size_t columns = points.fields.size();
    const std::size_t fourth = points.fields.back().name == "rcs" ? columns - 1 : 3;
    for (std::size_t i = 0; i < points.count; ++i)
        for (const std::size_t column : {std::size_t{0}, std::size_t{1}, std::size_t{2}, fourth})
            words.push_back(points.words[i * columns + column]);
    return bytes_of(words);
}

/// Version 1.0; the header is padded so that numbers begin at a multiple of 64.
template <typename Number>
std::string npy_of(std::span<const Number> values, std::size_t columns) {
    std::string header =
        fmt::format("{{'descr': '<f{}', 'fortran_order': False, 'shape': ({}, {}), }}",
                    sizeof(Number),
                    columns == 0 ? 0 : values.size() / columns,
                    columns);
    constexpr std::size_t before = 10;  // magic, version, length of the header
    while ((before + header.size() + 1) % 64 != 0)
        header += ' ';
    header += '\n';
    std::string file("\x93NUMPY\x01\x00", 8);
    file += static_cast<char>(header.size() & 0xffU);
    file += static_cast<char>(header.size() >> 8U);
    file += header;
    file.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    return file;
}

template <typename Number>
std::string npy_rows(const world::SensorFrame& frame) {
    const auto fields = world::point_fields(frame.kind);
    std::vector<Number> values(frame.data.size() / sizeof(std::uint32_t));
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::uint32_t word = 0;
        std::memcpy(&word, frame.data.data() + i * sizeof(word), sizeof(word));
        values[i] = fields[i % fields.size()].whole ? static_cast<Number>(word)
                                                    : static_cast<Number>(real(word));
    }
    return npy_of(std::span<const Number>(values), fields.size());
}

/// Ids of people in the background begin at 100,000,000: a float of 32 bits has only each eighth.
std::string npy_bytes(const world::SensorFrame& frame) {
    const auto fields = world::point_fields(frame.kind);
    const bool has_ids =
        std::any_of(fields.begin(), fields.end(), [](const world::PointField& one) {
            return one.name == "object";
        });
    return has_ids ? npy_rows<double>(frame) : npy_rows<float>(frame);
}

}  // namespace

std::string npy_file(std::span<const float> values, std::size_t columns) {
    return npy_of(values, columns);
}

std::string npy_file(std::span<const double> values, std::size_t columns) {
    return npy_of(values, columns);
}

std::string point_file(const world::SensorFrame& frame, PointFormat format) {
    if (format == PointFormat::npy)
        return npy_bytes(frame);
    const Points points = points_of(frame);
    switch (format) {
        case PointFormat::ply:
            return ply_header(points, frame) + bytes_of(points.words);
        case PointFormat::pcd:
            return pcd_header(points) + bytes_of(points.words);
        default:
            return kitti_bytes(points);
    }
}

void write_points(const world::SensorFrame& frame,
                  const std::filesystem::path& path,
                  PointFormat format) {
    files::write_file(path, "the points", point_file(frame, format));
}

}  // namespace reprise::render

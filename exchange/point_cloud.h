#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace reprise::exchange {

/// Points of a file that `reprise render` wrote: rows of 32-bit columns.
struct PointCloud {
    struct Column {
        std::string name;
        bool whole = false;  ///< a whole number without sign, else a real one
    };

    std::vector<Column> columns;
    std::string rows;  ///< bytes, little endian

    std::size_t row_bytes() const { return columns.size() * 4; }
};

/// Of a .ply, .pcd or .bin. Throws world::Error when it is none of ours.
PointCloud read_point_cloud(const std::filesystem::path& path);

}  // namespace reprise::exchange

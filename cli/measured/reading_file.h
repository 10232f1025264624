#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "world/external/point_fields.h"

namespace reprise::cli {

/// What one sensor read, tick by tick, for a table.
class ReadingFile {
  public:
    ReadingFile(world::SensorKind kind, double step) : kind_(kind), step_(step) {}

    void add(std::uint64_t tick, world::Reading reading) {
        rows_[tick].push_back(std::move(reading));
        ++count_;
    }

    std::size_t count() const { return count_; }

    /// Columns tick and time [s], then those of world::point_fields. Numbers of a .csv are the
    /// shortest that are read back as they are; a .npy holds doubles.
    void write(const std::filesystem::path& path) const;

  private:
    std::string csv() const;
    std::string npy() const;

    world::SensorKind kind_;
    double step_;
    std::map<std::uint64_t, std::vector<world::Reading>> rows_;
    std::size_t count_ = 0;
};

}  // namespace reprise::cli

#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "towns/import/town_import.h"

namespace reprise::towns {

/// Maps become towns, in a folder of this test's own. It has a comma in its name: SUMO's programs
/// split paths there.
class Imports : public ::testing::Test {
  protected:
    Imports();
    ~Imports() override;

    static std::string bytes(const std::filesystem::path& path);
    static std::filesystem::path village();

    std::filesystem::path empty(const std::string& name) const;
    std::filesystem::path write(const std::string& name, const std::string& text) const;
    /// What the user is told.
    std::string message(const TownImport& wish) const;
    /// Of two towns made of this map.
    void expect_same_bytes(const std::filesystem::path& map) const;
    /// Cars drive in what is made of this map.
    void expect_traffic(const std::filesystem::path& map, int cars, int ticks) const;

    std::filesystem::path folder_;
};

}  // namespace reprise::towns

#pragma once

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>

#include <gtest/gtest.h>

namespace reprise::test {

/// A folder for each test, with a name that a shell would take apart.
class Scratch : public ::testing::Test {
  protected:
    Scratch()
        : folder_(std::filesystem::path(::testing::TempDir()) /
                  ("reprise child, " + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }

    ~Scratch() override { std::filesystem::remove_all(folder_); }

    std::string read(const std::string& name) const {
        std::ostringstream all;
        all << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
        return all.str();
    }

    std::filesystem::path folder_;
};

/// A pipe that all children hold open as long as they live, and theirs as well.
class LifeLine {
  public:
    LifeLine() { EXPECT_EQ(pipe(ends_), 0); }

    ~LifeLine() {
        close(ends_[0]);
        hold_no_more();
    }

    LifeLine(const LifeLine&) = delete;
    LifeLine& operator=(const LifeLine&) = delete;

    /// Waits until none lives; a test that waits for ever fails by its time limit.
    void expect_all_gone() {
        hold_no_more();
        char none = 0;
        EXPECT_EQ(::read(ends_[0], &none, 1), 0) << "nobody writes into it";
    }

  private:
    void hold_no_more() {
        if (ends_[1] >= 0)
            close(ends_[1]);
        ends_[1] = -1;
    }

    int ends_[2] = {-1, -1};
};

}  // namespace reprise::test

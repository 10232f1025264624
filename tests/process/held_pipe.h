#pragma once

#include <array>
#include <unistd.h>

#include <gtest/gtest.h>

namespace reprise::process {

/// Its other end is closed when the last process that holds it has ended.
struct HeldPipe {
    HeldPipe() { EXPECT_EQ(pipe(ends.data()), 0); }

    ~HeldPipe() {
        for (const int end : ends)
            if (end >= 0)
                close(end);
    }

    HeldPipe(const HeldPipe&) = delete;
    HeldPipe& operator=(const HeldPipe&) = delete;

    /// Waits for a byte; false when nobody is left to write one.
    bool hear() const {
        char byte = 0;
        return read(ends[0], &byte, 1) == 1;
    }

    void say() const { EXPECT_EQ(write(ends[1], "x", 1), 1); }

    void let_go() {
        close(ends[1]);
        ends[1] = -1;
    }

    std::array<int, 2> ends{-1, -1};
};

}  // namespace reprise::process

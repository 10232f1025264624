#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "ground/paint/paint.h"

namespace reprise::ground {
namespace {

/// A walk along the whole line, segment by segment.
Line walked(const Line& line, double from, double to) {
    Line part;
    double passed = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Eigen::Vector3d along = line[i + 1] - line[i];
        const double first = std::max(from, passed);
        const double last = std::min(to, passed + along.norm());
        if (last - first > 1e-3) {
            if (part.empty())
                part.push_back(line[i] + along * ((first - passed) / along.norm()));
            part.push_back(line[i] + along * ((last - passed) / along.norm()));
        }
        passed += along.norm();
    }
    return part;
}

}  // namespace

// To the bit: pictures of old traces stay as they were.
TEST(MeasuredLine, StretchesAreThoseOfAWalkAlongIt) {
    Line line;
    for (int i = 0; i < 500; ++i)
        line.emplace_back(i * 0.3, std::sin(i * 0.1), i % 7 == 0 ? 0.2 : 0.0);
    line.push_back(line.back());  // a segment without a length
    line.emplace_back(400, 0, 0);
    const MeasuredLine measured(line);
    EXPECT_EQ(measured.length(), length_of(line));
    for (double from = -2; from < measured.length() + 2; from += 0.37)
        for (const double length : {1e-4, 0.2, 3.0, 1000.0})
            EXPECT_EQ(measured.stretch(from, from + length), walked(line, from, from + length))
                << from << " " << length;
    for (const Line& none : {Line{}, Line{{1, 2, 3}}}) {
        EXPECT_EQ(MeasuredLine(none).length(), 0);
        EXPECT_TRUE(MeasuredLine(none).stretch(0, 1).empty());
    }
}

}  // namespace reprise::ground

#include "ground/paint/paint.h"

#include <algorithm>

namespace reprise::ground {

double length_of(const Line& line) {
    double length = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        length += (line[i + 1] - line[i]).norm();
    return length;
}

Line stretch(const Line& line, double from, double to) {
    return MeasuredLine(line).stretch(from, to);
}

MeasuredLine::MeasuredLine(const Line& line) : line_(line), passed_{0} {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        passed_.push_back(passed_.back() + (line[i + 1] - line[i]).norm());
}

Line MeasuredLine::stretch(double from, double to) const {
    constexpr double shortest = 1e-3;
    Line part;
    const auto behind = std::upper_bound(passed_.begin(), passed_.end(), from);
    std::size_t i =
        behind == passed_.begin() ? 0 : static_cast<std::size_t>(behind - passed_.begin()) - 1;
    for (; i + 1 < line_.size() && passed_[i] < to; ++i) {
        const Eigen::Vector3d along = line_[i + 1] - line_[i];
        const double length = along.norm();
        const double first = std::max(from, passed_[i]);
        const double last = std::min(to, passed_[i + 1]);
        if (last - first > shortest) {
            if (part.empty())
                part.push_back(line_[i] + along * ((first - passed_[i]) / length));
            part.push_back(line_[i] + along * ((last - passed_[i]) / length));
        }
    }
    return part;
}

void Paint::line(const Line& line, double width) {
    if (line.size() < 2)
        return;
    for (std::vector<Eigen::Vector3d> piece : make_ribbon(line, -width / 2, width / 2).pieces) {
        for (Eigen::Vector3d& corner : piece)
            corner.z() += paint_height;
        builder_.add_face(piece, Surface::marking);
    }
}

void Paint::shape(const Line& centre, const world::Loop& corners) {
    std::vector<Eigen::Vector3d> raised;
    for (const Eigen::Vector2d& corner : corners) {
        // The segment that holds s.
        std::size_t i = 0;
        double passed = 0;
        double length = (centre[1] - centre[0]).norm();
        while (i + 2 < centre.size() && passed + length < corner.x()) {
            passed += length;
            ++i;
            length = (centre[i + 1] - centre[i]).norm();
        }
        const Eigen::Vector3d along = (centre[i + 1] - centre[i]) / length;
        const Eigen::Vector3d left = Eigen::Vector3d(-along.y(), along.x(), 0).normalized();
        raised.push_back(centre[i] + along * (corner.x() - passed) + left * corner.y() +
                         paint_height * Eigen::Vector3d::UnitZ());
    }
    builder_.add_face(raised, Surface::marking);
}

}  // namespace reprise::ground

#include "world/geometry2d.h"

#include <algorithm>
#include <numeric>

namespace reprise::world {

namespace {

constexpr double most_cells_a_side = 1024;

double distance_to_segment(const Eigen::Vector2d& p,
                           const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to) {
    const Eigen::Vector2d along = to - from;
    const double squared = along.squaredNorm();
    const double share = squared > 0 ? std::clamp((p - from).dot(along) / squared, 0.0, 1.0) : 0.0;
    return (p - from - share * along).norm();
}

/// Do they cross, each from one side of the other to the other side?
bool cross_each_other(const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to,
                      const Eigen::Vector2d& start,
                      const Eigen::Vector2d& end) {
    return cross(to - from, start - from) * cross(to - from, end - from) < 0 &&
           cross(end - start, from - start) * cross(end - start, to - start) < 0;
}

/// Places outside the grid belong to its border cells.
std::size_t cell_of(double cells, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(cells, 0.0, static_cast<double>(count - 1)));
}

}  // namespace

Loop in_plan(const std::vector<Vec3>& outline) {
    Loop loop;
    loop.reserve(outline.size());
    for (const Vec3& p : outline)
        loop.push_back(in_plan(p));
    return loop;
}

Loop in_plan(const std::vector<Eigen::Vector3d>& outline) {
    Loop loop;
    loop.reserve(outline.size());
    for (const Eigen::Vector3d& p : outline)
        loop.push_back(p.head<2>());
    return loop;
}

Box box_around(const Loop& loop, double margin) {
    Box box;
    for (const Eigen::Vector2d& p : loop)
        box.take(p, margin);
    return box;
}

double signed_area(const Loop& loop) {
    double twice_area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        twice_area += cross(loop[i] - loop[0], loop[(i + 1) % loop.size()] - loop[0]);
    return twice_area / 2;
}

bool contains(const Loop& loop, const Eigen::Vector2d& p) {
    int winding = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d& from = loop[i];
        const Eigen::Vector2d& to = loop[(i + 1) % loop.size()];
        if ((from.y() <= p.y()) == (to.y() <= p.y()))
            continue;
        const double left = cross(to - from, p - from);
        if (to.y() > from.y() && left > 0)
            ++winding;
        if (to.y() < from.y() && left < 0)
            --winding;
    }
    return winding != 0;
}

double distance_to(const Loop& loop, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    if (loop.size() > 2 && contains(loop, from))
        return 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::Vector2d& start = loop[i];
        const Eigen::Vector2d& end = loop[(i + 1) % loop.size()];
        if (cross_each_other(from, to, start, end))
            return 0;
        least = std::min({least,
                          distance_to_segment(from, start, end),
                          distance_to_segment(to, start, end),
                          distance_to_segment(start, from, to)});
    }
    return least;
}

BoxGrid::BoxGrid(const std::vector<Entry>& entries, double smallest_cell) {
    Box all;
    for (const Entry& entry : entries)
        all.take(entry.box);
    if (all.empty())
        all.low = all.high = Eigen::Vector2d::Zero();
    const Eigen::Vector2d size = all.high - all.low;
    low_ = all.low;
    cell_ = std::max(smallest_cell, size.maxCoeff() / most_cells_a_side);
    columns_ = 1 + static_cast<std::size_t>(size.x() / cell_);
    rows_ = 1 + static_cast<std::size_t>(size.y() / cell_);

    // How many lie in each cell, then where it begins, then what lies there.
    begin_.assign(columns_ * rows_ + 1, 0);
    for (const Entry& entry : entries)
        for_each_cell(entry.box, [&](std::size_t cell) { ++begin_[cell + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    items_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (const Entry& entry : entries)
        for_each_cell(entry.box, [&](std::size_t cell) { items_[next[cell]++] = entry.item; });
    put_in_order();
}

/// Makes the items of each cell ascending and without repeats; mostly they are so as they came.
void BoxGrid::put_in_order() {
    auto kept = items_.begin();
    auto first = items_.begin();
    for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) {
        const auto last = items_.begin() + begin_[cell + 1];
        if (!std::is_sorted(first, last))
            std::sort(first, last);
        const auto start = kept;
        for (; first != last; ++first)
            if (kept == start || *(kept - 1) != *first)
                *kept++ = *first;
        begin_[cell] = static_cast<std::uint32_t>(start - items_.begin());
    }
    begin_.back() = static_cast<std::uint32_t>(kept - items_.begin());
    items_.erase(kept, items_.end());
}

template <typename Visit>
void BoxGrid::for_each_cell(const Box& box, Visit&& visit) const {
    if (box.empty())
        return;
    const Eigen::Vector2d first = (box.low - low_) / cell_;
    const Eigen::Vector2d last = (box.high - low_) / cell_;
    for (std::size_t row = cell_of(first.y(), rows_); row <= cell_of(last.y(), rows_); ++row)
        for (std::size_t column = cell_of(first.x(), columns_);
             column <= cell_of(last.x(), columns_);
             ++column)
            visit(row * columns_ + column);
}

std::vector<std::uint32_t> BoxGrid::near(const Box& box) const {
    std::vector<std::uint32_t> found;
    int cells = 0;
    std::size_t most = 0;
    for_each_cell(box, [&](std::size_t cell) { most += begin_[cell + 1] - begin_[cell]; });
    found.reserve(most);
    for_each_cell(box, [&](std::size_t cell) {
        ++cells;
        found.insert(found.end(), items_.begin() + begin_[cell], items_.begin() + begin_[cell + 1]);
    });
    if (cells == 1)
        return found;
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

std::span<const std::uint32_t> BoxGrid::at(const Eigen::Vector2d& p) const {
    const Eigen::Vector2d place = (p - low_) / cell_;
    const std::size_t cell = cell_of(place.y(), rows_) * columns_ + cell_of(place.x(), columns_);
    return {items_.data() + begin_[cell], items_.data() + begin_[cell + 1]};
}

}  // namespace reprise::world

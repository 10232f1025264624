#include "towns/check/criterion.h"

#include <algorithm>

namespace reprise::towns {

Measured::Measured(std::string name, double limit, std::string unit, bool at_least) {
    criterion_.name = std::move(name);
    criterion_.limit = criterion_.figure = limit;
    criterion_.unit = std::move(unit);
    criterion_.at_least = at_least;
}

bool Measured::is_worse(double value, double other) const {
    return criterion_.at_least ? value < other : value > other;
}

void Measured::take(const std::string& name, const Eigen::Vector2d& position, double value) {
    if (count_++ == 0 || is_worse(value, criterion_.figure))
        criterion_.figure = value;
    if (!is_worse(value, criterion_.limit))
        return;
    const auto [place, is_new] =
        worst_of_name_.try_emplace(name, Criterion::Place{name, position, value});
    if (!is_new && is_worse(value, place->second.value))
        place->second = {name, position, value};
}

Criterion Measured::verdict(std::string looked_at) && {
    for (auto& [name, place] : worst_of_name_)
        criterion_.worst.push_back(std::move(place));
    std::stable_sort(
        criterion_.worst.begin(), criterion_.worst.end(), [&](const auto& one, const auto& other) {
            return is_worse(one.value, other.value);
        });
    criterion_.looked_at = std::move(looked_at);
    return std::move(criterion_);
}

Criterion none_of(std::string name, std::vector<Criterion::Place> faults, std::string looked_at) {
    Criterion criterion;
    criterion.name = std::move(name);
    criterion.figure = static_cast<double>(faults.size());
    criterion.looked_at = std::move(looked_at);
    criterion.worst = std::move(faults);
    return criterion;
}

std::string numbered(const char* what, std::size_t index) {
    return std::string(what) + " " + std::to_string(index);
}

}  // namespace reprise::towns

#include "wheel/pace.h"

#include <algorithm>

namespace reprise::wheel {

namespace {

constexpr double most_made_up = 0.1;  // [s]
constexpr double looked_back = 1;     // [s]

}  // namespace

double Pace::wait(std::uint64_t tick, double now) {
    arrivals_.push_back({tick, now});
    while (arrivals_.size() > 2 && now - arrivals_[1].at >= looked_back)
        arrivals_.pop_front();
    if (wanted_ <= 0)
        return 0;
    const double due = anchor_.at + static_cast<double>(tick - anchor_.tick) * step_ / wanted_;
    if (!begun_ || now - due > most_made_up) {
        begun_ = true;
        anchor_ = {tick, now};
        return 0;
    }
    return std::max(due - now, 0.0);
}

double Pace::factor() const {
    if (arrivals_.size() < 2)
        return 0;
    const Arrival& first = arrivals_.front();
    const Arrival& last = arrivals_.back();
    const double real = last.at - first.at;
    return real <= 0 ? 0 : static_cast<double>(last.tick - first.tick) * step_ / real;
}

}  // namespace reprise::wheel

#include "walkers/neighbours.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace reprise::walkers {

void Neighbours::add_posts(std::span<const Body> posts) {
    for (const Body& post : posts) {
        posts_.push_back(post);
        widest_post_ = std::max(widest_post_, post.radius);
    }
    const auto place = [](const Body& post) { return std::pair(post.place.x(), post.place.y()); };
    std::stable_sort(posts_.begin(), posts_.end(), [&](const Body& one, const Body& other) {
        return place(one) < place(other);
    });
    const auto known = [&](const Body& one, const Body& other) {
        return place(one) == place(other);
    };
    posts_.erase(std::unique(posts_.begin(), posts_.end(), known), posts_.end());
}

std::size_t Neighbours::add(const Body& body, bool of_car) {
    if (added_.empty())
        widest_ = 0;
    added_.push_back({body, body.place.x(), of_car});
    widest_ = std::max(widest_, body.radius);
    return added_.size() - 1;
}

void Neighbours::sort() {
    keys_.clear();
    for (std::uint32_t i = 0; i < added_.size(); ++i)
        keys_.push_back({added_[i].x, added_[i].body.id, i});
    std::sort(keys_.begin(), keys_.end());
    bodies_.clear();
    index_.resize(added_.size());
    for (const Key& key : keys_) {
        index_[key.index] = static_cast<std::uint32_t>(bodies_.size());
        bodies_.push_back(added_[key.index]);
    }
}

template <typename Visit>
void Neighbours::visit(const Body& self, double reach, From from, Visit&& see) const {
    const double wide = reach + drift;
    auto entry = std::lower_bound(
        bodies_.begin(), bodies_.end(), self.place.x() - wide, [](const Entry& one, double x) {
            return one.x < x;
        });
    for (; entry != bodies_.end() && entry->x <= self.place.x() + wide; ++entry)
        if (entry->body.id != self.id && (from.cars || !entry->of_car))
            see(entry->body);
    if (!from.posts)
        return;
    auto post = std::lower_bound(
        posts_.begin(), posts_.end(), self.place.x() - reach, [](const Body& one, double x) {
            return one.place.x() < x;
        });
    for (; post != posts_.end() && post->place.x() <= self.place.x() + reach; ++post)
        see(*post);
}

void Neighbours::around(const Body& self, double reach, From from, std::vector<Body>& found) const {
    found.clear();
    const auto distance = [&](const Body& body) { return (body.place - self.place).squaredNorm(); };
    visit(self, reach, from, [&](const Body& body) {
        const double far = distance(body);
        if (far < reach * reach && far > 1e-6)
            found.push_back(body);
    });
    std::stable_sort(found.begin(), found.end(), [&](const Body& one, const Body& other) {
        const double near = distance(one);
        const double far = distance(other);
        return near != far ? near < far : one.id < other.id;
    });
}

bool Neighbours::is_clear(const Body& self, const Eigen::Vector2d& to, From from) const {
    constexpr double touching = 0.02;  // [m] of air
    bool clear = true;
    const double widest = from.posts ? std::max(widest_, widest_post_) : widest_;
    visit(self, self.radius + widest + touching, from, [&](const Body& body) {
        const double room = self.radius + body.radius + touching;
        if (!clear || std::abs(body.place.y() - to.y()) >= room)
            return;
        const double now = (body.place - self.place).norm();
        const double then = (body.place - to).norm();
        clear = then >= room || then > now;
    });
    return clear;
}

}  // namespace reprise::walkers

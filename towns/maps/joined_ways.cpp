// How it goes: depth first. A path is followed from way to way; where it meets itself, a ring is
//   cut off; where it can go no further, its last way is dropped, and another tried from there.
#include "towns/maps/joined_ways.h"

#include <cstddef>
#include <map>
#include <optional>

namespace reprise::towns {

namespace {

class Joiner {
  public:
    explicit Joiner(const std::vector<const NodeIds*>& ways);

    JoinedWays joined;

  private:
    /// A way in the direction that the path takes.
    struct Step {
        const NodeIds* way;
        bool forward;

        std::int64_t from() const { return forward ? way->front() : way->back(); }

        std::int64_t to() const { return forward ? way->back() : way->front(); }
    };

    void follow(std::size_t first);
    std::optional<std::size_t> take_at(std::int64_t node);
    void add_ring(std::size_t begin);
    void drop_from(std::size_t begin);

    const std::vector<const NodeIds*>& ways_;
    std::vector<bool> used_;  ///< [way]
    std::map<std::int64_t, std::vector<std::size_t>>
        at_end_;  ///< ways at a node, the next one last
    std::vector<Step> path_;
    std::map<std::int64_t, std::size_t> passed_;  ///< steps of the path, by where they begin
};

Joiner::Joiner(const std::vector<const NodeIds*>& ways) : ways_(ways), used_(ways.size(), false) {
    for (std::size_t i = ways_.size(); i-- > 0;) {
        at_end_[ways_[i]->front()].push_back(i);
        at_end_[ways_[i]->back()].push_back(i);
    }
    for (std::size_t i = 0; i < ways_.size(); ++i)
        if (!used_[i])
            follow(i);
}

void Joiner::follow(std::size_t first) {
    used_[first] = true;
    path_.push_back({ways_[first], true});
    passed_.emplace(path_.front().from(), 0);
    while (!path_.empty()) {
        const std::int64_t here = path_.back().to();
        if (const auto step = passed_.find(here); step != passed_.end()) {
            const std::size_t begin = step->second;
            add_ring(begin);
            drop_from(begin);
        } else if (const auto next = take_at(here)) {
            passed_.emplace(here, path_.size());
            path_.push_back({ways_[*next], ways_[*next]->front() == here});
        } else {
            joined.all_close = false;
            drop_from(path_.size() - 1);
        }
    }
}

std::optional<std::size_t> Joiner::take_at(std::int64_t node) {
    std::vector<std::size_t>& here = at_end_[node];
    while (!here.empty()) {
        const std::size_t way = here.back();
        here.pop_back();
        if (used_[way])
            continue;
        used_[way] = true;
        return way;
    }
    return std::nullopt;
}

void Joiner::add_ring(std::size_t begin) {
    NodeIds ring{path_[begin].from()};
    for (std::size_t i = begin; i < path_.size(); ++i) {
        const NodeIds& way = *path_[i].way;
        if (path_[i].forward)
            ring.insert(ring.end(), way.begin() + 1, way.end());
        else
            ring.insert(ring.end(), way.rbegin() + 1, way.rend());
    }
    joined.rings.push_back(std::move(ring));
}

void Joiner::drop_from(std::size_t begin) {
    for (; path_.size() > begin; path_.pop_back())
        passed_.erase(path_.back().from());
}

}  // namespace

JoinedWays join_ways(const std::vector<const NodeIds*>& ways) {
    return Joiner(ways).joined;
}

}  // namespace reprise::towns

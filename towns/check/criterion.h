#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace reprise::towns {

/// One promise of a town, with what was found. `town check` prints a table of them.
struct Criterion {
    /// Where a promise is broken, so that one can go there.
    struct Place {
        std::string name;          ///< of the lane, signal, prop, ... that is there
        Eigen::Vector2d position;  ///< world
        double value = 0;          ///< in the criterion's unit; of a thing that is wrong: 1
    };

    std::string name;          ///< few words, such as "ground under lanes"
    double figure = 0;         ///< the worst value, or how many things are wrong
    double limit = 0;          ///< the last figure that passes
    std::string unit;          ///< "m", "%"; empty: a count
    bool at_least = false;     ///< must the figure reach the limit, or may it not exceed it?
    std::string looked_at;     ///< such as "23,120 places on 184 lanes"
    std::vector<Place> worst;  ///< all beyond the limit, the worst first

    bool passed() const { return at_least ? figure >= limit : figure <= limit; }
};

/// Gathers a figure that is measured at many places: the worst one counts. Of each name's places
/// the worst is kept.
class Measured {
  public:
    /// As in Criterion.
    Measured(std::string name, double limit, std::string unit, bool at_least = false);

    void take(const std::string& name, const Eigen::Vector2d& position, double value);

    std::size_t count() const { return count_; }

    /// Nothing taken: the figure is the limit.
    Criterion verdict(std::string looked_at) &&;

  private:
    bool is_worse(double value, double other) const;

    Criterion criterion_;
    std::size_t count_ = 0;
    std::map<std::string, Criterion::Place> worst_of_name_;
};

/// Of Criterion::worst as many are shown.
inline constexpr std::size_t shown_places = 5;

/// A criterion that nothing may break: `faults` in the order in which they were found.
Criterion none_of(std::string name, std::vector<Criterion::Place> faults, std::string looked_at);

/// "building 12": how a thing without a name is called.
std::string numbered(const char* what, std::size_t index);

}  // namespace reprise::towns

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace reprise::world {
class Hasher;
}

namespace reprise::scripting {

/// Named streams of random numbers. The n-th draw of a stream is a function of the run's seed, the
/// stream's name and n alone: a draw added to one stream moves nothing in another.
class Streams {
  public:
    explicit Streams(std::uint64_t seed) : seed_(seed) {}

    /// In [0, 1).
    double draw(const std::string& stream);

    /// In [low, high]; low <= high.
    std::int64_t draw_integer(const std::string& stream, std::int64_t low, std::int64_t high);

    std::size_t size() const { return counts_.size(); }

    bool has(const std::string& stream) const { return counts_.count(stream) != 0; }

    void digest(world::Hasher& hasher) const;

  private:
    std::uint64_t seed_;
    std::map<std::string, std::uint64_t> counts_;
};

}  // namespace reprise::scripting

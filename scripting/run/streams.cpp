#include "scripting/run/streams.h"

#include "world/digest.h"
#include "world/random.h"

namespace reprise::scripting {

double Streams::draw(const std::string& stream) {
    std::uint64_t& count = counts_[stream];
    const std::uint64_t item = world::digest128(stream).low() + count++;
    return world::draw(seed_, 0, world::Purpose::scenario, item);
}

std::int64_t Streams::draw_integer(const std::string& stream, std::int64_t low, std::int64_t high) {
    const auto span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1;
    const double share = draw(stream);
    const auto step = static_cast<std::uint64_t>(share * static_cast<double>(span));
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + step);
}

void Streams::digest(world::Hasher& hasher) const {
    hasher.add(static_cast<std::uint64_t>(counts_.size()));
    for (const auto& [stream, count] : counts_) {
        hasher.add_text(stream);
        hasher.add(count);
    }
}

}  // namespace reprise::scripting

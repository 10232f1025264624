#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace reprise::cli {

/// One moment of a data set.
struct DatasetFrame {
    std::size_t trace = 0;  ///< by its index
    std::uint64_t tick = 0;
    std::string split;
};

/// What sensors see in a frame, or so many ticks before it: of such sweeps nobody asks for labels.
struct Moment {
    std::size_t id = 0;        ///< of the frame
    std::uint64_t before = 0;  ///< [ticks]

    Moment() = default;

    // NOLINTNEXTLINE(google-explicit-constructor): a frame is a moment
    Moment(std::size_t frame, std::uint64_t ticks_before = 0) : id(frame), before(ticks_before) {}

    bool is_sweep() const { return before > 0; }
};

/// A part of a data set, such as train.
struct Split {
    std::string name;
    double share = 0;
};

/// "train:0.8,val:0.2"; what is left of 1 is val. Throws world::Error.
std::vector<Split> read_split(const std::string& text);

/// Says which part each frame belongs to. Frames a second apart show nearly the same: so parts are
/// made of whole traces, whose order is that of their chains, not that in which they were named;
/// where there are fewer traces than parts, of the time of each trace, one part behind the other.
/// `chains`: of each trace. `frames` by trace and tick.
void split_frames(const std::vector<Split>& splits,
                  const std::vector<std::string>& chains,
                  std::vector<DatasetFrame>& frames);

}  // namespace reprise::cli

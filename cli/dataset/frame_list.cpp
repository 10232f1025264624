#include "cli/dataset/frame_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "world/check.h"
#include "world/external/rig.h"

namespace reprise::cli {

namespace {

/// Of `count` things in a row the part of each: every part has one where there are enough.
std::vector<std::size_t> parts_of(const std::vector<Split>& splits, std::size_t count) {
    std::vector<std::size_t> parts(count, splits.size() - 1);
    double sum = 0;
    std::size_t from = 0;
    for (std::size_t i = 0; i < splits.size(); ++i) {
        sum += splits[i].share;
        auto to = static_cast<std::size_t>(std::llround(sum * static_cast<double>(count)));
        const std::size_t behind = splits.size() - 1 - i;
        if (count >= splits.size())
            to = std::clamp(to, from + 1, count - behind);
        for (std::size_t k = from; k < std::min(to, count); ++k)
            parts[k] = i;
        from = std::max(from, to);
    }
    return parts;
}

}  // namespace

std::vector<Split> read_split(const std::string& text) {
    const auto refuse = [&](const std::string& why) {
        throw world::Error(fmt::format("--split: {}, got '{}'", why, text));
    };
    std::vector<Split> splits;
    double sum = 0;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        const std::size_t colon = part.find(':');
        Split split{part.substr(0, colon), 0};
        const char* last = part.data() + part.size();
        const char* first = colon == std::string::npos ? last : part.data() + colon + 1;
        const auto [stop, error] = std::from_chars(first, last, split.share);
        if (!world::is_sensor_name(split.name) || first == last || error != std::errc() ||
            stop != last || !(split.share > 0 && split.share <= 1))
            refuse("expected NAME:SHARE,... such as train:0.8,val:0.2");
        for (const Split& other : splits)
            if (other.name == split.name)
                refuse("'" + split.name + "' is there twice");
        sum += split.share;
        splits.push_back(split);
        begin = end + 1;
    }
    constexpr double enough = 1e-9;
    if (sum > 1 + enough)
        refuse(fmt::format("shares must not be more than 1 together, these are {:g}", sum));
    if (sum < 1 - enough) {
        for (const Split& other : splits)
            if (other.name == "val")
                refuse(fmt::format("shares must be 1 together, these are {:g}", sum));
        splits.push_back({"val", 1 - sum});
    }
    return splits;
}

void split_frames(const std::vector<Split>& splits,
                  const std::vector<std::string>& chains,
                  std::vector<DatasetFrame>& frames) {
    if (chains.size() >= splits.size()) {
        std::vector<std::size_t> order(chains.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
            return chains[one] < chains[other];
        });
        const std::vector<std::size_t> parts = parts_of(splits, chains.size());
        for (std::size_t place = 0; place < order.size(); ++place)
            for (DatasetFrame& frame : frames)
                if (frame.trace == order[place])
                    frame.split = splits[parts[place]].name;
        return;
    }
    for (auto first = frames.begin(); first != frames.end();) {
        const auto last = std::find_if(first, frames.end(), [&](const DatasetFrame& one) {
            return one.trace != first->trace;
        });
        const std::vector<std::size_t> parts =
            parts_of(splits, static_cast<std::size_t>(last - first));
        for (std::size_t part : parts)
            (first++)->split = splits[part].name;
    }
}

}  // namespace reprise::cli

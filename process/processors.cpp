#include "process/processors.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sched.h>
#include <string>

#include "world/units.h"

namespace reprise::process {

namespace {

namespace fs = std::filesystem;

/// A file's first two words; of a file that is not there none.
std::optional<double> quotient_in(const fs::path& path) {
    std::ifstream file(path);
    double quota = 0, period = 0;  // [us] "max" is no number
    if (file >> quota >> period && quota > 0 && period > 0)
        return quota / period;
    return std::nullopt;
}

std::optional<double> quotient_of(const fs::path& quota_path, const fs::path& period_path) {
    std::ifstream quota_file(quota_path), period_file(period_path);
    double quota = 0, period = 0;  // [us] -1: no limit
    if (quota_file >> quota && period_file >> period && quota > 0 && period > 0)
        return quota / period;
    return std::nullopt;
}

/// Of one group, whichever version it is of.
double granted_by(const fs::path& group) {
    const auto granted = quotient_in(group / "cpu.max");
    return granted ? *granted
                   : quotient_of(group / "cpu.cfs_quota_us", group / "cpu.cfs_period_us")
                         .value_or(world::infinity);
}

/// The least of a group and those above it.
double granted_within(const fs::path& root, fs::path group) {
    double granted = granted_by(root);
    for (; group.has_relative_path(); group = group.parent_path())
        granted = std::min(granted, granted_by(root / group.relative_path()));
    return granted;
}

}  // namespace

double granted_processors(const fs::path& groups, const fs::path& mounted) {
    std::ifstream file(groups);
    double granted = world::infinity;
    for (std::string line; std::getline(file, line);) {  // number:controllers:/path
        const auto first = line.find(':');
        const auto second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos)
            continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool is_second_version = controllers.empty();
        const bool has_time = ("," + controllers + ",").find(",cpu,") != std::string::npos;
        if (is_second_version || has_time)
            granted = std::min(granted,
                               granted_within(is_second_version ? mounted : mounted / controllers,
                                              line.substr(second + 1)));
    }
    return granted;
}

std::size_t processors() {
    cpu_set_t mine;
    CPU_ZERO(&mine);
    const int usable = sched_getaffinity(0, sizeof(mine), &mine) == 0 ? CPU_COUNT(&mine) : 1;
    return static_cast<std::size_t>(std::max(1.0, std::min<double>(usable, granted_processors())));
}

}  // namespace reprise::process

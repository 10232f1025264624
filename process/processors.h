#pragma once

#include <cstddef>
#include <filesystem>

namespace reprise::process {

/// How many processors this process may keep busy, 1 at least: as many as it may run on, or the
/// whole ones among those whose time its control groups grant it (`docker run --cpus=2`).
std::size_t processors();

/// [processors] whose time the control groups grant, those above them included; infinite where they
/// grant all. `groups`: of the process, as /proc/self/cgroup lists them. `mounted`: where they are,
/// of version 2 or of version 1, and in a container the process's own.
double granted_processors(const std::filesystem::path& groups = "/proc/self/cgroup",
                          const std::filesystem::path& mounted = "/sys/fs/cgroup");

}  // namespace reprise::process

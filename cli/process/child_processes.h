#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace reprise::cli {

/// Does each piece of work in a copy of this process, as many at a time as there are processors,
/// and waits for all. Returns their exit codes in the same order; 70 for one that a signal ended.
/// What this process has simulated so far, each copy has, and none sees what another does. Only one
/// thread may run: a copy has no other (checked).
std::vector<int> in_child_processes(std::size_t count, const std::function<int(std::size_t)>& work);

}  // namespace reprise::cli

#pragma once

#include <functional>
#include <string>

namespace reprise::cli {

/// Does the work in a copy of this process, and waits. Returns what it returns; what it throws is
/// thrown here. Whatever else ends it is told as world::Error "NAME: ...": more than 8 GB of memory
/// or 600 s of processor time, or (std::runtime_error) a crash. When this process is told to end
/// (Ctrl-C), the copy and its own children are gone first, and world::Error is thrown: in each case
/// the caller goes on and can tidy up. Only one thread may run (a copy has no other).
std::string in_worker(const std::string& name, const std::function<std::string()>& work);

}  // namespace reprise::cli

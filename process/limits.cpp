#include "process/limits.h"

#include <csignal>
#include <cstring>
#include <sys/resource.h>

#include <fmt/format.h>

namespace reprise::process {

namespace {

/// Where less is allowed already, that stays.
template <typename Resource>
void set(Resource what, std::optional<std::uint64_t> value, std::uint64_t grace = 0) {
    if (!value)
        return;
    const rlimit bound{*value, *value + grace};
    setrlimit(what, &bound);
}

}  // namespace

void impose(const Limits& limits) {
    set(RLIMIT_AS, limits.memory);
    set(RLIMIT_CPU, limits.seconds, 10);  // at the harder one it would be killed without a reason
    set(RLIMIT_FSIZE, limits.file);
    set(RLIMIT_CORE, 0);
}

std::string reason(int signal, const Limits& limits) {
    if (signal == SIGXCPU && limits.seconds)
        return fmt::format("was stopped: it needed more than {} s of processor time",
                           *limits.seconds);
    rlimit ours{};
    const bool has_ours =
        getrlimit(RLIMIT_FSIZE, &ours) == 0 && ours.rlim_cur < limits.file.value_or(RLIM_INFINITY);
    if (signal == SIGXFSZ && has_ours)
        return fmt::format("was stopped: no file may be larger than {:.1f} kB here (ulimit -f)",
                           static_cast<double>(ours.rlim_cur) / 1e3);
    if (signal == SIGXFSZ && limits.file)
        return fmt::format("was stopped: it wrote more than {} MB", *limits.file >> 20);
    return fmt::format("crashed (signal {}, {})", signal, strsignal(signal));
}

}  // namespace reprise::process

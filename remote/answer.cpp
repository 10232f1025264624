#include "remote/answer.h"

#include <fmt/format.h>

namespace reprise::remote {

namespace {

constexpr std::size_t longest_reason = 300;  // [bytes] of it in ours

/// What is wrong with a value that a driver said, or "".
std::string fault_of(const char* name, double value, double low, double high) {
    if (value >= low && value <= high)
        return "";
    return fmt::format("said {} = {} where [{:g}, {:g}] is possible", name, value, low, high);
}

}  // namespace

std::string fault_of(const Control& control, std::uint64_t shown) {
    if (control.tick() != shown)
        return fmt::format(
            "answered tick {} when tick {} was to be answered", control.tick(), shown);
    for (const std::string& fault : {fault_of("throttle", control.throttle(), 0, 1),
                                     fault_of("brake", control.brake(), 0, 1),
                                     fault_of("steer", control.steer(), -1, 1)})
        if (!fault.empty())
            return fault;
    return "";
}

std::string shortened(const flatbuffers::String& text) {
    return text.size() <= longest_reason ? text.str()
                                         : text.str().substr(0, longest_reason) + " ...";
}

}  // namespace reprise::remote

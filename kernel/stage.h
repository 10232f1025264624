#pragma once

#include <cstdint>

namespace reprise::kernel {

/// The stages of a step, in their order; each ends with a digest of its name. See Kernel::step.
enum class Stage : std::uint8_t { scenario, controls, traffic, pedestrians, physics, measurements };

}  // namespace reprise::kernel

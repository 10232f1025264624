#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "kernel/kernel.h"
#include "replay/compare/divergence.h"
#include "replay/trace_reader.h"

namespace reprise::kernel {

/// Runs a trace again from what it carries, with the recorded controls, and compares every tick's
/// bytes, as far as the trace's level keeps them, and digests: the first difference, or nothing.
/// `on_tick` is given each tick that agreed, whole.
/// What differs only in a digest is followed until it shows in the record. Then every other byte of
/// the file, and whether the run ends there and so. Of a part of a run and of one that was cut off
/// there is nothing to tell how it went on: its length, its branches behind the last tick.
/// A damaged chunk is compared as far as its bytes can be had, so that the first wrong tick is
/// named, not the chunk.
std::optional<replay::Divergence> verify(
    replay::TraceReader& recorded,
    const std::function<void(const world::SealedTick&)>& on_tick = {});

/// The same for ticks 1 to `last`, with a kernel that was made from that recording and goes on
/// afterwards; the file itself is not checked.
std::optional<replay::Divergence> follow(
    Kernel& kernel,
    replay::TraceReader& recorded,
    std::uint64_t last,
    const std::function<void(const world::SealedTick&)>& on_tick = {});

}  // namespace reprise::kernel

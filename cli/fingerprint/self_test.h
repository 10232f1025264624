#pragma once

namespace reprise::cli {

/// Before anything is recorded: are arithmetic, locale and maths those that every recorded run has?
/// Throws world::Error that says which is not, and what to look for. About 0.1 ms.
/// Sources of the values: docs/determinism.md.
void self_test();

}  // namespace reprise::cli

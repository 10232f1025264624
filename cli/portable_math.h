#pragma once

namespace reprise::cli {

/// Checks that sin, exp and their kin come from this executable, not from the C library, and give
/// the bits that they should (values that tell glibc's variants apart: docs/determinism.md). Throws
/// world::CheckFailed that names the function. 10 us.
void check_portable_math();

}  // namespace reprise::cli

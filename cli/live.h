#pragma once

namespace reprise::cli {

/// The process that a run starts beside it for a vehicle that carries a rig: renders what it is
/// asked for until the run is over. Returns the exit code.
int live();

}  // namespace reprise::cli

#pragma once

#include <functional>

#include "cli/options/dataset_options.h"

namespace reprise::cli {

/// `reprise dataset --check DIR`: makes all of it again, elsewhere, and compares byte for byte.
/// Returns the exit code. `make`: the command itself.
int check_dataset(const DatasetOptions& options,
                  const std::function<int(const DatasetOptions&)>& make);

}  // namespace reprise::cli

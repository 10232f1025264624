#pragma once

#include "cli/options/dataset_options.h"

namespace reprise::cli {

/// `reprise dataset`: pictures of many traces under many weathers, and their labels once. Returns
/// the exit code.
int dataset(const DatasetOptions& options);

}  // namespace reprise::cli

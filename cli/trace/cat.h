#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise cat`: ticks as JSON lines or CSV on the standard output.
int cat(const CatOptions& options);

/// `reprise get`: one part of a trace (its scenario, its network, ...).
int get(const GetOptions& options);

}  // namespace reprise::cli

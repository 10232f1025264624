#pragma once

#include "cli/options/tool_options.h"

namespace reprise::cli {

/// `reprise show`: a trace as a page to watch in a browser.
int show(const ShowOptions& options);

}  // namespace reprise::cli

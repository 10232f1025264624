#pragma once

#include <functional>

#include "cli/options/render_options.h"

namespace reprise::cli {

/// `reprise render --check MANIFEST`: makes all of it again, and compares byte for byte. Returns
/// the exit code. `render`: the command itself.
int check_render(const RenderOptions& options,
                 const std::function<int(const RenderOptions&)>& render);

}  // namespace reprise::cli

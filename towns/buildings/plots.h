#pragma once

#include "towns/furnish/placement_context.h"

namespace reprise::towns {

/// The place's plots, into town.plots, with what belongs on them: trees, benches and bins in parks,
/// a fountain and benches in squares, swings on playgrounds, cars on car parks, trees in forests.
void lay_out_plots(PlacementContext& context);

}  // namespace reprise::towns

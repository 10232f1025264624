#pragma once

#include <string>

#include "cli/discover/sheet.h"

namespace reprise::cli {

/// The towns that a scenario in this folder, or in this program's own, can name.
Sheet town_sheet();

/// The lanes of a town; `all`: those inside junctions, crossings and walking areas, too.
Sheet lane_sheet(const std::string& town, bool all);

/// The scenarios in this folder, in its folder scenarios/, and this program's own.
Sheet scenario_sheet();

}  // namespace reprise::cli

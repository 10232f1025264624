#pragma once

#include <filesystem>
#include <string>

namespace reprise::towns {

/// What a map says must be possible: places on the globe, ways whose nodes lie near each other,
/// lanes and layers that a road can have. One mistyped longitude makes a town of a continent's
/// size, and netconvert builds as many lanes as it is told. A node that is missing is no mistake:
/// extracts are cut. Throws world::Error "MAP: way 7: ..."; `called` is how the user calls it.
/// Keeps 16 bytes a node.
void check_openstreetmap(const std::filesystem::path& map, const std::string& called);

}  // namespace reprise::towns

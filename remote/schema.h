#pragma once

#include <cstdint>
#include <string_view>

namespace reprise::remote {

/// Of the wire. Counted up when an old driver would misunderstand a new run; additions do not.
inline constexpr std::uint32_t wire_version = 1;

/// Digest of wire.fbs and of the world's schemas that it carries.
std::string_view schema_digest();

}  // namespace reprise::remote

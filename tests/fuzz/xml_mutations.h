#pragma once

#include <cstdint>
#include <string>

namespace reprise::test {

/// Another text of XML: a value becomes a strange one or another element's, an element is left out,
/// comes twice or loses an attribute. Bytes alone would hardly ever leave XML well-formed.
std::string mutated_xml(const std::string& xml, std::uint32_t seed);

}  // namespace reprise::test

#pragma once

#include <string>

#include "replay/compare/divergence.h"

namespace reprise::cli {

/// Says in which lines two builds differ, if they do; equal bytes are promised by one build only.
/// `headline` such as "another build recorded this"; the names are of the two columns.
void print_other_build(const std::string& headline,
                       const std::string& expected_name,
                       const replay::Fingerprint& expected,
                       const std::string& found_name,
                       const replay::Fingerprint& found);

}  // namespace reprise::cli

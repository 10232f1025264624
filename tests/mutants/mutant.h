#pragma once

#include <cstdlib>
#include <cstring>

namespace reprise::mutants {

/// Is this the mutation that REPRISE_MUTANT names? Only in the copy of the sources that mutants.py
/// makes: what is shipped never asks.
inline bool is_on(const char* name) {
    static const char* const chosen = std::getenv("REPRISE_MUTANT");
    return chosen != nullptr && std::strcmp(chosen, name) == 0;
}

}  // namespace reprise::mutants

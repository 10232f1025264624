#include "cli/fingerprint/this_build.h"

#include "cli/fingerprint/full_fingerprint.h"

namespace reprise::cli {

replay::Fingerprint this_build() {
    replay::Fingerprint lines;
    for (const auto& [key, value] : full_fingerprint()) {
        lines.emplace_back();
        lines.back().key = key;
        lines.back().value = value;
    }
    return lines;
}

}  // namespace reprise::cli

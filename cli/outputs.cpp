#include "cli/outputs.h"

#include "world/check.h"

namespace reprise::cli {

void refuse_same_file(const std::filesystem::path& input, const std::filesystem::path& output) {
    std::error_code ignored;
    if (std::filesystem::equivalent(input, output, ignored))
        throw world::Error(output.string() +
                           ": that is the trace to be read; name another file with -o");
}

}  // namespace reprise::cli

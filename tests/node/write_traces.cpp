// write_traces FOLDER: traces of every size at which a trace changes its shape: none, one tick, a
// chunk less one, a chunk, one more, several.
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "tests/replay/synthetic_run.h"

int main(int argc, char** argv) {
    using reprise::test::SyntheticRun;
    if (argc != 2)
        return 2;
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const std::uint64_t ticks : {0, 1, 63, 64, 65, 150}) {
        SyntheticRun run;
        run.ticks = ticks;
        reprise::test::write_trace(folder / fmt::format("ticks_{}.mcap", ticks), run);
    }
    return 0;
}

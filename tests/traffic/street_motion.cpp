// What the traffic of recorded runs does that no real car does: a table for each trace.
#include "tests/support/street_motion.h"

#include <cstdio>
#include <exception>

#include "replay/trace_reader.h"

namespace {

void tell(const char* path) {
    reprise::replay::TraceReader trace(path);
    reprise::test::StreetMotion motion(trace.recording().town,
                                       static_cast<double>(trace.episode().step_ns) * 1e-9);
    for (std::uint64_t tick = trace.first(); tick <= trace.last(); ++tick)
        motion.see(trace.tick(tick).view);
    std::printf("%s\n%s\n", path, motion.text().c_str());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        for (int i = 1; i < argc; ++i)
            tell(argv[i]);
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "street_motion: %s\n", failure.what());
        return 2;
    }
}

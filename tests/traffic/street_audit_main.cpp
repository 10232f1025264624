// What happened in the streets of recorded runs: intrusions, gridlock, collisions and their causes.
//
//   street_audit TRACE ...     exit status 1: somebody was in somebody, gridlock, or a collision
//                              that an attentive driver could have avoided
#include <cstdio>
#include <exception>

#include "ground/obstacles.h"
#include "replay/trace_reader.h"
#include "tests/traffic/street_audit.h"

namespace {

bool is_clean(const reprise::test::StreetAudit& audit) {
    for (const auto& intrusion : audit.intrusions())
        if (!intrusion.is_wreck && intrusion.depth > 0.3)
            return false;
    for (const auto& minute : audit.minutes())
        if (reprise::test::StreetAudit::is_gridlock(minute))
            return false;
    for (const auto& collision : audit.collisions())
        if (collision.avoidable)
            return false;
    return true;
}

bool tell(const char* path) {
    reprise::replay::TraceReader trace(path);
    const auto walls = reprise::ground::obstacles_of(trace.recording().town);
    reprise::test::StreetAudit audit(
        trace.recording().town, walls, static_cast<double>(trace.episode().step_ns) * 1e-9);
    for (std::uint64_t tick = trace.first(); tick <= trace.last(); ++tick)
        audit.see(trace.tick(tick).view);
    audit.finish();
    std::printf("%s\n%s\n", path, audit.text().c_str());
    return is_clean(audit);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        bool clean = true;
        for (int i = 1; i < argc; ++i)
            clean = tell(argv[i]) && clean;
        return clean ? 0 : 1;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "street_audit: %s\n", failure.what());
        return 2;
    }
}

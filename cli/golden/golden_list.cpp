#include "cli/golden/golden_list.h"

#include <string_view>

#include <fmt/format.h>

#include "cli/golden/golden_case.h"
#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "replay/table/value.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

int list_orphans(const FoundCases& found) {
    int code = exit_good;
    for (const GoldenCase& one : found.cases) {
        if (one.state != GoldenCase::State::orphan)
            continue;
        say("{}: there is no {}\n", one.golden.string(), one.scenario.string());
        code = exit_differs;
    }
    return code;
}

}  // namespace

int golden_list(const GoldenListOptions& options) {
    const FoundCases found = find_cases(options.paths);
    if (options.orphans)
        return list_orphans(found);
    int code = exit_good;
    for (const GoldenCase& one : found.cases) {
        if (one.state == GoldenCase::State::no_golden) {
            say("{}  no golden yet\n", one.scenario.string());
            continue;
        }
        const bool orphan = one.state == GoldenCase::State::orphan;
        try {
            const replay::Golden golden = replay::load_golden(one.golden);
            std::string because;
            replay::append_json(std::string_view(golden.because), because);
            say("{}  {}, {}; because {}\n",
                one.golden.string(),
                orphan ? "ORPHAN: no " + one.scenario.string()
                       : command_line(run_words(one, golden.given)),
                golden.verdict,
                because);
        } catch (const world::Error& error) {
            say("{}  unreadable: {}\n", one.golden.string(), error.what());
            code = exit_bad_input;
        }
    }
    return code;
}

}  // namespace reprise::cli

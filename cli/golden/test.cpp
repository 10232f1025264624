#include "cli/golden/test.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "cli/golden/golden_case.h"
#include "cli/golden/golden_files.h"
#include "cli/golden/golden_runs.h"
#include "cli/golden/golden_suite.h"
#include "cli/golden/junit.h"
#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

using State = GoldenCase::State;
using Counts = std::map<CaseResult, std::size_t>;

Counts count(const std::vector<CaseReport>& reports) {
    Counts counts;
    for (const CaseReport& report : reports)
        ++counts[report.result];
    return counts;
}

int exit_code(Counts counts) {
    if (counts[CaseResult::nondeterministic] > 0)
        return exit_nondeterministic;
    if (counts[CaseResult::error] > 0)
        return exit_bad_input;
    const bool failed = counts[CaseResult::changed] + counts[CaseResult::failed] +
                            counts[CaseResult::no_golden] + counts[CaseResult::not_run] +
                            counts[CaseResult::orphan] >
                        0;
    return failed ? exit_differs : exit_good;
}

/// Cases that changed in the same way, where there are several.
void print_groups(const std::vector<CaseReport>& reports) {
    std::map<std::string, std::vector<std::string>> groups;
    for (const CaseReport& report : reports)
        if (report.result == CaseResult::changed)
            groups[report.signature].push_back(report.tested.label());
    for (const auto& [signature, labels] : groups) {
        if (labels.size() < 2)
            continue;
        std::string list;
        for (std::size_t i = 0; i < std::min<std::size_t>(labels.size(), 5); ++i)
            list += (i == 0 ? "" : ", ") + labels[i];
        say("{} alike ({}): {}{}\n",
            labels.size(),
            signature,
            list,
            labels.size() > 5 ? ", ..." : "");
    }
}

void print_summary(Counts counts, double seconds) {
    std::string text = fmt::format("{} passed, {} changed, {} nondeterministic",
                                   counts[CaseResult::passed],
                                   counts[CaseResult::changed],
                                   counts[CaseResult::nondeterministic]);
    const auto add = [&](CaseResult result, const char* what) {
        if (counts[result] > 0)
            text += fmt::format(", {} {}", counts[result], what);
    };
    add(CaseResult::failed, "failed");
    add(CaseResult::not_run, "not run");
    add(CaseResult::no_golden, "without a golden");
    add(CaseResult::orphan, "orphaned");
    add(CaseResult::error, "with errors");
    say("{} ({:.1f} s)\n", text, seconds);
}

int list_cases(const FoundCases& found) {
    for (const GoldenCase& one : found.cases)
        say("{}{}\n",
            one.label(),
            one.state == State::ready       ? ""
            : one.state == State::no_golden ? "  (no golden yet)"
            : one.state == State::external  ? "  (checks only: another program drives)"
                                            : "  (orphan)");
    return exit_good;
}

void check_drivers(const TestOptions& options, const FoundCases& found) {
    if (options.drivers.empty())
        return;
    const auto is_external = [](const GoldenCase& one) { return one.state == State::external; };
    if (std::none_of(found.cases.begin(), found.cases.end(), is_external))
        throw world::Error("--driver " + options.drivers.front() +
                           ": none of these scenarios has a car that another program drives");
    for (const std::string& driver : options.drivers) {
        const std::string who = driver.substr(driver.find('=') + 1);
        if (who == "tcp:0")
            throw world::Error("--driver " + world::printable(driver) +
                               ": nobody would hear which port is free: name one");
        if ((who.starts_with("socket:") || who.starts_with("tcp:")) && options.jobs != 1)
            throw world::Error("--driver " + world::printable(driver) +
                               ": one run at a time can be at a socket or port: add --jobs 1");
    }
}

/// A name that was typed wrong would pass for a driver that was tested.
void check_all_drove(const TestOptions& options, const std::vector<CaseReport>& reports) {
    std::vector<std::string> driven;
    for (const CaseReport& report : reports) {
        if (report.tested.state != State::external)
            continue;
        if (!report.driven)
            return;  // somebody might have come later
        driven.insert(driven.end(), report.driven->begin(), report.driven->end());
    }
    for (const std::string& driver : options.drivers) {
        const std::string name = driver.substr(0, driver.find('='));
        if (std::find(driven.begin(), driven.end(), name) == driven.end())
            throw world::Error(fmt::format(
                "--driver {}: no car of that name was driven by another program in any of these "
                "scenarios{}",
                world::printable(driver),
                world::did_you_mean(name, driven)));
    }
}

}  // namespace

int test(const TestOptions& options) {
    const FoundCases found = find_cases(options.paths);
    for (const std::string& note : found.notes)
        say(stderr, "{}\n", note);
    if (found.cases.empty())
        throw world::Error("there are no scenarios and no goldens" +
                           (options.paths.empty() ? "" : " in " + options.paths.front()));
    if (options.list)
        return list_cases(found);
    check_drivers(options, found);
    if (!options.junit.empty())
        check_writable(options.junit);  // rather now than after an hour
    try {
        const SuiteResult result = run_suite(options, found.cases);
        for (const CaseReport& report : result.reports)
            say_lines(to_text(report));
        print_groups(result.reports);
        const Counts counts = count(result.reports);
        print_summary(counts, result.seconds);
        if (!options.junit.empty())
            write_junit(options.junit, result.reports, result.seconds);
        check_all_drove(options, result.reports);
        return exit_code(counts);
    } catch (const process::Stopped& stopped) {
        say(stderr, "reprise: interrupted; no run is left behind\n");
        return exit_stopped + stopped.signal;
    }
}

}  // namespace reprise::cli

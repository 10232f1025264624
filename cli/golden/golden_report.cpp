#include "cli/golden/golden_report.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/golden/golden_files.h"
#include "cli/process/guard.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

using replay::Changed;
using replay::Golden;
using replay::GoldenDifference;

constexpr std::size_t most_rows = 4;  ///< of one kind; a report stays below a screen
constexpr std::size_t widest = 180;   ///< [characters] of a row

std::string changed_text(const Changed& change) {
    return fmt::format("{}: golden {}, now {}", change.what, change.expected, change.found);
}

std::string rows(const std::string& key, const std::vector<Changed>& changes) {
    std::string text;
    for (std::size_t i = 0; i < std::min(most_rows, changes.size()); ++i)
        text += report_row(i == 0 ? key : "", changed_text(changes[i]));
    if (changes.size() > most_rows)
        text += report_row("", fmt::format("and {} more", changes.size() - most_rows));
    return text;
}

std::string verdict_rows(const Golden& expected, const GoldenDifference& difference) {
    if (!difference.verdicts.empty())
        return rows("verdict", difference.verdicts);
    return report_row("verdict",
                      fmt::format("unchanged: {} ({})",
                                  expected.verdict,
                                  world::count_of(expected.checks.size(), "check")));
}

std::string event_rows(const Golden& found, const GoldenDifference& difference) {
    if (!difference.events.first)
        return difference.events.all == 0
                   ? ""
                   : report_row("events", fmt::format("unchanged: {}", difference.events.all));
    const Changed& first = *difference.events.first;
    std::string text = report_row(
        "events",
        fmt::format("{} of {} differ, first{}",
                    difference.events.different,
                    difference.events.all,
                    first.line == 0 ? "" : fmt::format(" {}:{}", found.scenario, first.line)));
    return text + report_row("", "golden  " + first.expected) +
           report_row("", "now     " + first.found);
}

std::string checkpoint_rows(const Golden& expected, const GoldenDifference& difference) {
    if (!expected.pins.empty())
        return report_row("pinned", fmt::format("{}", fmt::join(expected.pins, ", ")));
    if (!difference.checkpoints.first)
        return report_row("digests", "unchanged: every tick of every stage");
    const auto time = [&](std::uint64_t tick) { return replay::time_text(tick, expected.step_ns); };
    const Changed& first = *difference.checkpoints.first;
    return report_row("digests",
                      fmt::format("first differ between {} and {}, in {}; {} of {} differ",
                                  time(difference.equal_until),
                                  time(first.tick),
                                  first.what.empty() ? "the history only" : first.what,
                                  difference.checkpoints.different,
                                  difference.checkpoints.all));
}

std::string state_rows(const Golden& expected, const GoldenDifference& difference) {
    if (!difference.states.first)
        return "";
    const Changed& first = *difference.states.first;
    return report_row("states",
                      fmt::format("{} of {} differ, first at {}",
                                  difference.states.different,
                                  difference.states.all,
                                  replay::time_text(first.tick, expected.step_ns))) +
           report_row("", changed_text(first));
}

std::string build_rows(const Golden& expected, const Golden& found) {
    std::vector<Changed> changes;
    for (const replay::BuildDifference& line :
         replay::build_differences(expected.build, found.build))
        changes.push_back({0, line.key, line.expected, line.found, 0});
    if (changes.empty())
        return "";
    return report_row("build",
                      "another build made the golden; between builds equal numbers are not "
                      "promised") +
           rows("", changes);
}

}  // namespace

const char* to_word(CaseResult result) {
    switch (result) {
        case CaseResult::passed:
            return "passed";
        case CaseResult::changed:
            return "CHANGED";
        case CaseResult::nondeterministic:
            return "NONDETERMINISTIC";
        case CaseResult::failed:
            return "FAILED";
        case CaseResult::no_golden:
            return "NO GOLDEN";
        case CaseResult::not_run:
            return "NOT RUN";
        case CaseResult::orphan:
            return "ORPHAN";
        case CaseResult::error:
            break;
    }
    return "ERROR";
}

std::string report_row(const std::string& key, const std::string& value) {
    std::string text;
    std::istringstream lines(value);
    for (std::string line; std::getline(lines, line);) {
        if (line.size() > widest)
            line = line.substr(0, widest) + " ...";
        text += fmt::format("  {:<10}{}\n", text.empty() ? key : "", line);
    }
    return text;
}

std::string to_text(const CaseReport& report) {
    return fmt::format(
               "{:<9} {}  {}\n", to_word(report.result), report.tested.label(), report.headline) +
           report.text;
}

std::string difference_text(const Golden& expected,
                            const Golden& found,
                            const GoldenDifference& difference) {
    return verdict_rows(expected, difference) + rows("details", difference.details) +
           event_rows(found, difference) + checkpoint_rows(expected, difference) +
           state_rows(expected, difference) +
           rows("start", replay::start_differences(expected, found)) + build_rows(expected, found);
}

std::string failed_checks_text(const Golden& run) {
    std::string text;
    std::size_t rows = 0;
    for (const replay::GoldenCheck& check : run.checks)
        if (check.status != "passed" && rows++ < most_rows)
            text += report_row(
                rows == 1 ? "checks" : "",
                fmt::format(
                    "{}: {}{}{}",
                    check.name,
                    check.status,
                    check.tick == 0 ? "" : " at " + replay::time_text(check.tick, run.step_ns),
                    check.detail.empty() ? "" : ", " + check.detail));
    if (rows > most_rows)
        text += report_row("", fmt::format("and {} more", rows - most_rows));
    return text + report_row("ended", run.reason);
}

std::string signature_of(const GoldenDifference& difference) {
    const std::string stages =
        difference.checkpoints.first ? difference.checkpoints.first->what : "";
    return fmt::format("{}, first in {}",
                       replay::to_word(difference.severity),
                       stages.empty() ? "no stage" : stages.substr(0, stages.find(',')));
}

std::optional<RunFailure> failure_of(const process::ProgramResult& result,
                                     const std::filesystem::path& log) {
    if (result.signal == 0 && (result.code == exit_good || result.code == exit_differs))
        return std::nullopt;
    RunFailure failure;
    const std::string said = last_lines(log, 6);
    if (result.signal != 0) {
        failure.kind = "crash";
        failure.headline = fmt::format("the run was ended by signal {} ({}) after {:.1f} s",
                                       result.signal,
                                       strsignal(result.signal),
                                       result.seconds);
        failure.text = report_row("it said", said.empty() ? "nothing" : said);
        return failure;
    }
    if (result.code == exit_bad_input) {
        failure.kind = "script";
        failure.headline = last_lines(log, 1);
        if (failure.headline.starts_with("reprise: "))
            failure.headline.erase(0, 9);
        if (failure.headline.find("is driven by another program: say which") != std::string::npos)
            failure.text = report_row("next",
                                      "such scenarios have no golden, only their checks are "
                                      "tested: reprise test --driver NAME='COMMAND'");
        return failure;
    }
    failure.kind = result.code == exit_our_fault ? "fault" : "crash";
    failure.headline = fmt::format("the run ended with exit status {}", result.code);
    failure.text = report_row("it said", said.empty() ? "nothing" : said);
    return failure;
}

}  // namespace reprise::cli

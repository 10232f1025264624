// The heart of `reprise test`.
//   must      fail for one reason only, say which, and say how to come back to it; never let a
//             case pass that was not run
//   assumes   that `reprise run` makes equal bytes of equal inputs, and finds out when it does not
//   goes      every case at once in processes of their own; those that differ from their golden
//             once more, one at a time; then what became of each. Where another program drives,
//             there is no golden: a stack under development changes its last bits daily; the
//             verdict counts
//   keeps     the traces of cases that failed, in the output folder
#include "cli/golden/golden_suite.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "cli/golden/golden_files.h"
#include "cli/golden/golden_runs.h"
#include "cli/process/progress.h"
#include "cli/process/reproduce.h"
#include "cli/process/temporary_folder.h"
#include "replay/compare/divergence.h"
#include "replay/golden/golden_difference.h"
#include "replay/golden/pins.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/external/external_drivers.h"
#include "world/story/wording.h"
#include "world/tick.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;
using State = GoldenCase::State;

/// One case on its way through the suite.
struct Running {
    std::optional<replay::Golden> golden;
    GoldenRun run;
    fs::path trace;
    fs::path log;
    std::optional<replay::Golden> candidate;
    std::optional<replay::GoldenDifference> difference;
    bool differs_again = false;  ///< two runs of it are not one
};

/// What a run said of a driver that it lost: a line on stderr, before its summary.
std::string complaint(const fs::path& log) {
    constexpr std::size_t summary = 200;  // lines: checks are a line each
    const std::string mark = "reprise: the driver of ";
    std::istringstream lines(last_lines(log, summary));
    std::string last;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(mark))
            last = line.substr(std::strlen("reprise: "));
    return last;
}

/// The names of all cars that other programs drove.
std::vector<std::string> driven_in(replay::TraceReader& trace) {
    world::ExternalDrivers drivers;
    std::vector<std::string> names;
    for (std::uint64_t tick = 1; tick <= trace.ticks(); ++tick) {
        drivers.hear(*trace.tick(tick).view.tick);
        for (const auto& [actor, spawn] : drivers.spawns())
            if (std::find(names.begin(), names.end(), spawn.command.text) == names.end())
                names.push_back(spawn.command.text);
    }
    return names;
}

class Suite {
  public:
    Suite(const TestOptions& options, std::vector<GoldenCase> cases)
        : options_(options),
          runner_(options.jobs),
          progress_("testing", "runs", cases.size() * options.repeat),
          running_(cases.size()),
          reports_(cases.size()) {
        for (std::size_t i = 0; i < cases.size(); ++i)
            reports_[i].tested = std::move(cases[i]);
    }

    void run() {
        std::vector<std::size_t> ready;
        for (std::size_t i = 0; i < reports_.size(); ++i)
            if (prepare(i))
                ready.push_back(i);
        run_first(ready);
        for (const std::size_t i : ready)
            guard(i, [&] { judge(i); });
        repeat(ready);
        for (const std::size_t i : ready)
            if (running_[i].difference && !running_[i].differs_again)
                guard(i, [&] { run_again(i); });
    }

    const std::vector<CaseReport>& reports() const { return reports_; }

    double seconds() const { return progress_.seconds(); }

  private:
    /// An error in one case is reported as that case's; the others go on.
    template <typename Work>
    void guard(std::size_t i, const Work& work) {
        try {
            work();
        } catch (const world::Error& error) {
            fail(i, {"infrastructure", error.what(), ""});
        }
    }

    void fail(std::size_t i, const RunFailure& failure) {
        CaseReport& report = reports_[i];
        report.result = CaseResult::error;
        report.error_kind = failure.kind;
        report.headline = failure.headline;
        report.text = failure.text;
        running_[i].difference.reset();
    }

    /// Whether there is something to run.
    bool prepare(std::size_t i) {
        CaseReport& report = reports_[i];
        const GoldenCase& tested = report.tested;
        if (tested.state == State::orphan) {
            report.result = CaseResult::orphan;
            report.headline = "there is no " + tested.scenario.string();
            report.text =
                report_row("next", "rm " + shell_path(tested.golden) + "   # or bring it back");
            return false;
        }
        if (tested.state == State::no_golden && options_.checks) {
            plan_run(i);
            return true;
        }
        if (tested.state == State::no_golden) {
            report.result = CaseResult::no_golden;
            report.headline = "no golden yet";
            report.text = report_row("next", accept_command(tested));
            return false;
        }
        if (tested.state == State::external)
            return prepare_external(i);
        Running& running = running_[i];
        try {
            running.golden = replay::load_golden(tested.golden);
        } catch (const world::Error& error) {
            fail(i, {"golden", error.what(), ""});
            return false;
        }
        report.given = running.golden->given;
        if (options_.checks) {
            const bool has_story = running.golden->pins.empty() || running.golden->ticks > 0;
            running.golden->pins = {"verdict"};
            if (has_story)
                running.golden->pins.emplace_back("events");
            replay::keep_pinned(*running.golden);
        }
        plan_run(i);
        return true;
    }

    bool prepare_external(std::size_t i) {
        CaseReport& report = reports_[i];
        if (options_.drivers.empty()) {
            report.result = CaseResult::not_run;
            report.headline = "another program drives, and none was named";
            report.text = report_row(
                "next",
                "reprise test " + shell_path(report.tested.scenario) + " --driver NAME='COMMAND'");
            return false;
        }
        report.drivers = options_;
        plan_run(i);
        return true;
    }

    void plan_run(std::size_t i) {
        const CaseReport& report = reports_[i];
        Running& running = running_[i];
        running.trace = temporary_ / fmt::format("{}.mcap", i);
        running.log = temporary_ / fmt::format("{}.log", i);
        running.run = {run_words(report.tested, report.given, running.trace, report.drivers),
                       running.log};
    }

    void run_first(const std::vector<std::size_t>& ready) {
        std::vector<GoldenRun> runs;
        for (const std::size_t i : ready)
            runs.push_back(running_[i].run);
        const auto results = runner_.run(runs, [&](std::size_t done) { progress_.update(done); });
        progress_.clear();
        for (std::size_t n = 0; n < ready.size(); ++n) {
            reports_[ready[n]].seconds = results[n].seconds;
            if (const auto failure = failure_of(results[n], runs[n].log)) {
                fail(ready[n], *failure);
                move_file(runs[n].log, kept(ready[n], ".log"));
            }
        }
    }

    /// Every case so often as was asked for: a run that is not the first one over again is found
    /// here, whatever the golden says.
    void repeat(const std::vector<std::size_t>& ready) {
        std::vector<std::size_t> going;
        for (const std::size_t i : ready)
            if (reports_[i].result != CaseResult::error)
                going.push_back(i);
        for (std::size_t round = 1; round < options_.repeat && !going.empty(); ++round) {
            std::vector<GoldenRun> runs;
            for (const std::size_t i : going)
                runs.push_back(run_beside(i, "again"));
            const auto results = runner_.run(
                runs, [&](std::size_t done) { progress_.update(reports_.size() * round + done); });
            for (std::size_t n = 0; n < going.size(); ++n)
                guard(going[n],
                      [&] { compare_runs(going[n], results[n], runs[n].log, round + 1); });
            std::erase_if(going, [&](std::size_t i) {
                return running_[i].differs_again || reports_[i].result == CaseResult::error;
            });
        }
        progress_.clear();
        if (options_.repeat > 1)
            for (const std::size_t i : going)
                reports_[i].headline += fmt::format("; {} runs, one history", options_.repeat);
    }

    GoldenRun run_beside(std::size_t i, const char* word) const {
        const CaseReport& report = reports_[i];
        return {run_words(report.tested,
                          report.given,
                          temporary_ / fmt::format("{}.{}.mcap", i, word),
                          report.drivers),
                temporary_ / fmt::format("{}.{}.log", i, word)};
    }

    void compare_runs(std::size_t i,
                      const process::ProgramResult& result,
                      const fs::path& log,
                      std::size_t number) {
        if (const auto failure = failure_of(result, log)) {
            fail(i, *failure);
            reports_[i].text += report_row(
                "",
                fmt::format("in run {} of {}; it went through before", number, options_.repeat));
            return;
        }
        const fs::path trace = temporary_ / fmt::format("{}.again.mcap", i);
        replay::TraceReader expected(running_[i].trace);
        replay::TraceReader found(trace);
        const auto divergence = replay::compare(expected, found);
        if (!divergence)
            return;
        running_[i].differs_again = true;
        const fs::path first_kept = kept(i, ".mcap");
        const fs::path second_kept = kept(i, ".second.mcap");
        copy_file_whole(running_[i].trace, first_kept);
        move_file(trace, second_kept);
        tell_nondeterministic(i, *divergence, first_kept, second_kept);
        reports_[i].headline += fmt::format(" (run {} of {})", number, options_.repeat);
    }

    fs::path kept(std::size_t i, const std::string& ending) const {
        return place_in(options_.output, reports_[i].tested.label()).string() + ending;
    }

    /// Compares a candidate with its golden.
    void judge(std::size_t i) {
        CaseReport& report = reports_[i];
        Running& running = running_[i];
        if (report.result == CaseResult::error)
            return;
        replay::TraceReader trace(running.trace);
        if (!running.golden) {
            judge_checks(i, replay::make_golden(trace));
            if (report.tested.state == State::external && report.result == CaseResult::passed)
                report.driven = driven_in(trace);
            return;
        }
        running.candidate = replay::make_golden(trace, running.golden->sampling);
        running.candidate->pins = running.golden->pins;
        replay::keep_pinned(*running.candidate);
        report.starts = running.candidate->starts;
        running.difference = replay::compare(*running.golden, *running.candidate);
        if (!running.difference)
            pass(i);
    }

    /// Without a golden: whether the checks hold, and the drivers lasted.
    void judge_checks(std::size_t i, const replay::Golden& run) {
        CaseReport& report = reports_[i];
        report.starts = run.starts;
        const auto collisions =
            std::count_if(run.events.begin(), run.events.end(), [](const auto& event) {
                return event.kind == world::EnumNameEventKind(world::EventKind::collision);
            });
        report.headline =
            fmt::format("checks only: verdict {}, {}, {}",
                        run.verdict,
                        world::count_of(run.checks.size(), "check"),
                        world::count_of(static_cast<std::uint64_t>(collisions), "collision"));
        if (run.verdict == "passed" || run.verdict == "completed") {
            remove_kept(i);
            return;
        }
        report.result = CaseResult::failed;
        report.text = failed_checks_text(run);
        if (run.verdict == "driver_lost")
            report.text += report_row("because", complaint(running_[i].log));
        const fs::path trace = kept(i, ".mcap");
        copy_file_whole(running_[i].trace, trace);
        report.text += report_row("next", "reprise info " + shell_path(trace));
    }

    void remove_kept(std::size_t i) {
        for (const char* ending : {".mcap", ".second.mcap", ".log"})
            remove_stale(kept(i, ending), options_.output);
    }

    void pass(std::size_t i) {
        CaseReport& report = reports_[i];
        const replay::Golden& golden = *running_[i].golden;
        const replay::Golden& candidate = *running_[i].candidate;
        report.headline = fmt::format(
            "{}, verdict {}", candidate.pins.empty() ? "equal" : "as pinned", candidate.verdict);
        for (const replay::Changed& change : replay::start_differences(golden, candidate))
            report.headline += fmt::format("; {} changed without effect", change.what);
        if (!options_.keep.empty() && golden.chain == candidate.chain)
            keep_trace(running_[i].trace, candidate.chain, options_.keep);
        remove_kept(i);
    }

    /// Runs the candidate a second time, alone: two equal runs mean that the behaviour changed, two
    /// different ones that it is nondeterministic.
    void run_again(std::size_t i) {
        Running& running = running_[i];
        const fs::path second = temporary_ / fmt::format("{}.second.mcap", i);
        const GoldenRun again = run_beside(i, "second");
        const process::ProgramResult result = runner_.run({again}).front();
        const fs::path first_kept = kept(i, ".mcap");
        copy_file_whole(running.trace, first_kept);
        if (const auto failure = failure_of(result, again.log)) {
            fail(i, *failure);
            reports_[i].text +=
                report_row("", "it went through once, and not when it was run again");
            return;
        }
        replay::TraceReader expected(running.trace);
        replay::TraceReader found(second);
        if (const auto divergence = replay::compare(expected, found)) {
            const fs::path second_kept = kept(i, ".second.mcap");
            move_file(second, second_kept);
            tell_nondeterministic(i, *divergence, first_kept, second_kept);
        } else {
            tell_changed(i, first_kept);
        }
    }

    void tell_nondeterministic(std::size_t i,
                               const replay::Divergence& divergence,
                               const fs::path& first,
                               const fs::path& second) {
        CaseReport& report = reports_[i];
        report.result = CaseResult::nondeterministic;
        report.headline =
            "two runs of the same scenario differ; the golden says nothing about that";
        report.text = report_row(
            "first",
            replay::to_text(divergence, replay::TraceReader(running_[i].trace).episode().step_ns));
        report.text +=
            report_row("next", "reprise diff " + shell_path(first) + " " + shell_path(second));
        report.text += report_row("", "reprise verify " + shell_path(first));
    }

    void tell_changed(std::size_t i, const fs::path& trace) {
        CaseReport& report = reports_[i];
        Running& running = running_[i];
        report.result = CaseResult::changed;
        report.headline = fmt::format("{}; repeatable, 2 of 2 runs equal",
                                      replay::to_word(running.difference->severity));
        report.signature = signature_of(*running.difference);
        report.text = difference_text(*running.golden, *running.candidate, *running.difference);
        std::string next;
        if (const auto before = kept_golden_trace(i)) {
            replay::TraceReader expected(*before);
            replay::TraceReader found(trace);
            if (const auto divergence = replay::compare(expected, found))
                report.text +=
                    report_row("exactly", replay::to_text(*divergence, running.golden->step_ns));
            next = "reprise diff " + shell_path(*before) + " " + shell_path(trace) + "\n";
        }
        next += "reprise info " + shell_path(trace) + "\n" + accept_command(report.tested);
        report.text += report_row("next", next);
    }

    /// The trace that the golden was made from, when it was kept.
    std::optional<fs::path> kept_golden_trace(std::size_t i) const {
        if (options_.keep.empty())
            return std::nullopt;
        return kept_trace(running_[i].golden->chain, options_.keep);
    }

    const TestOptions& options_;
    GoldenRunner runner_;
    TemporaryFolder temporary_;
    Progress progress_;
    std::vector<Running> running_;
    std::vector<CaseReport> reports_;
};

}  // namespace

SuiteResult run_suite(const TestOptions& options, std::vector<GoldenCase> cases) {
    Suite suite(options, std::move(cases));
    suite.run();
    return {suite.reports(), suite.seconds()};
}

}  // namespace reprise::cli

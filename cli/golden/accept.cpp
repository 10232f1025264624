// `reprise accept`.
//   must      take only what is named, fails now, and is repeatable; never leave half a file
//   goes      each case twice; what stands against it; then all goldens, or none
#include "cli/golden/accept.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "cli/golden/golden_case.h"
#include "cli/golden/golden_files.h"
#include "cli/golden/golden_report.h"
#include "cli/golden/golden_runs.h"
#include "cli/process/guard.h"
#include "cli/process/progress.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "cli/process/temporary_folder.h"
#include "files/output_file.h"
#include "replay/golden/golden_difference.h"
#include "replay/golden/pins.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;

struct Candidate {
    GoldenCase tested;
    replay::GivenSetup given;
    std::vector<std::string> pins;
    std::optional<replay::Golden> before;  ///< none: the case is new
    std::optional<replay::Golden> golden;
    std::string text;  ///< of `golden`
    fs::path trace;
};

replay::GivenSetup given_by(const RunOptions& start, const fs::path& golden) {
    replay::GivenSetup given;
    if (start.town)
        given.town = stored_town(*start.town, golden);
    if (start.seed)
        given.seed = std::to_string(*start.seed);
    if (start.seconds)
        given.seconds = decimal(*start.seconds);
    given.parameters = start.parameters;
    return given;
}

Candidate prepare(const AcceptOptions& options, const std::string& name) {
    Candidate candidate;
    candidate.tested = named_case(name, options.name);
    const GoldenCase& tested = candidate.tested;
    candidate.given = given_by(options.start, tested.golden);
    const bool given = candidate.given != replay::GivenSetup{};
    if (tested.state == GoldenCase::State::ready)
        candidate.before = replay::load_golden(tested.golden);
    candidate.pins = options.pins;
    if (options.pins.empty() && candidate.before)
        candidate.pins = candidate.before->pins;
    if (std::find(candidate.pins.begin(), candidate.pins.end(), "numbers") != candidate.pins.end())
        candidate.pins.clear();  // that is everything
    if (given && tested.name.empty())
        throw world::Error(
            "accept: --town, --seed, --for and --set make a case of its own: give it a name with "
            "--case");
    if (!given && candidate.before)
        candidate.given = candidate.before->given;
    else if (!given && !tested.name.empty())
        throw world::Error("accept: the case '" + tested.name +
                           "' is new: say what makes it different (--town, --seed, --for, --set)");
    return candidate;
}

void check_reason(const std::string& because) {
    if (because.find_first_not_of(" \t\r\n.") == std::string::npos)
        throw world::Error(
            "accept: say why the new behaviour is right: --because \"...\"; it is kept in the "
            "golden");
}

/// A golden named twice would be run and written twice.
void check_distinct(const std::vector<Candidate>& candidates) {
    for (const Candidate& one : candidates)
        for (const Candidate& other : candidates)
            if (&one != &other && one.tested.golden == other.tested.golden)
                throw world::Error("accept: " + one.tested.label() + " is named twice");
}

class Acceptance {
  public:
    Acceptance(const AcceptOptions& options, std::vector<Candidate> candidates)
        : options_(options),
          runner_(options.jobs),
          candidates_(std::move(candidates)) {}

    int run() {
        run_all();
        int code = exit_good;
        for (std::size_t i = 0; i < candidates_.size(); ++i)
            code = std::max(code, judge(i));
        if (code != exit_good) {
            say("nothing was written\n");
            return code;
        }
        for (Candidate& candidate : candidates_)
            write(candidate);
        return exit_good;
    }

  private:
    fs::path trace(std::size_t i, int run) const {
        return temporary_ / fmt::format("{}.{}.mcap", i, run);
    }

    fs::path log(std::size_t i, int run) const {
        return temporary_ / fmt::format("{}.{}.log", i, run);
    }

    void run_all() {
        std::vector<GoldenRun> runs;
        for (std::size_t i = 0; i < candidates_.size(); ++i)
            for (int run = 0; run < 2; ++run)
                runs.push_back(
                    {run_words(candidates_[i].tested, candidates_[i].given, trace(i, run)),
                     log(i, run)});
        Progress progress("running", "runs", runs.size());
        results_ = runner_.run(runs, [&](std::size_t done) { progress.update(done); });
    }

    static void refuse(const Candidate& candidate, const std::string& why) {
        say("REFUSED   {}  {}\n", candidate.tested.label(), why);
    }

    /// What stands against it, printed; exit_good when nothing does.
    int judge(std::size_t i) {
        Candidate& candidate = candidates_[i];
        for (int run = 0; run < 2; ++run) {
            const process::ProgramResult& result = results_[2 * i + static_cast<std::size_t>(run)];
            if (const auto failure = failure_of(result, log(i, run))) {
                refuse(candidate, failure->headline);
                say_lines(failure->text);
                return exit_bad_input;
            }
        }
        replay::TraceReader first(trace(i, 0));
        replay::TraceReader second(trace(i, 1));
        if (const auto divergence = replay::compare(first, second)) {
            refuse(candidate, "nondeterministic: two runs of it differ");
            say_lines(report_row("first", replay::to_text(*divergence, first.episode().step_ns)));
            return exit_nondeterministic;
        }
        candidate.golden = replay::make_golden(first);
        candidate.golden->because = options_.because;
        candidate.golden->given = candidate.given;
        candidate.golden->pins = candidate.pins;
        try {
            replay::check_pins(*candidate.golden);
        } catch (const world::Error& error) {
            refuse(candidate, error.what());
            return exit_bad_input;
        }
        replay::keep_pinned(*candidate.golden);
        candidate.text = replay::to_text(*candidate.golden);
        candidate.trace = first.path();
        return judge_change(candidate, first);
    }

    int judge_change(Candidate& candidate, replay::TraceReader& trace) {
        if (!candidate.before)
            return exit_good;
        replay::Golden now = replay::make_golden(trace, candidate.before->sampling);
        now.pins = candidate.before->pins;
        replay::keep_pinned(now);
        const auto difference = replay::compare(*candidate.before, now);
        if (!difference && candidate.given == candidate.before->given &&
            candidate.pins == candidate.before->pins) {
            refuse(candidate, "equal to its golden: there is nothing to accept");
            return exit_differs;
        }
        if (difference) {
            say("CHANGED   {}  {}\n",
                candidate.tested.label(),
                replay::to_word(difference->severity));
            say_lines(difference_text(*candidate.before, now, *difference));
        }
        return exit_good;
    }

    void write(const Candidate& candidate) {
        files::write_file(candidate.tested.golden, "the golden", candidate.text);
        if (!options_.keep.empty())
            keep_trace(candidate.trace, candidate.golden->chain, options_.keep);
        say("{}  {}: verdict {}, {}, {}, {}, {:.1f} kB\n",
            candidate.before ? "accepted" : "new     ",
            candidate.tested.golden.string(),
            candidate.golden->verdict,
            world::count_of(candidate.golden->checks.size(), "check"),
            world::count_of(candidate.golden->events.size(), "event"),
            replay::time_text(candidate.golden->ticks, candidate.golden->step_ns),
            static_cast<double>(candidate.text.size()) / 1e3);
    }

    const AcceptOptions& options_;
    GoldenRunner runner_;
    TemporaryFolder temporary_;
    std::vector<Candidate> candidates_;
    std::vector<process::ProgramResult> results_;
};

}  // namespace

int accept(const AcceptOptions& options) {
    check_reason(options.because);
    std::vector<Candidate> candidates;
    for (const std::string& name : options.names)
        candidates.push_back(prepare(options, name));
    check_distinct(candidates);
    for (const Candidate& candidate : candidates)
        check_writable(candidate.tested.golden);
    try {
        return Acceptance(options, std::move(candidates)).run();
    } catch (const process::Stopped& stopped) {
        say(stderr, "reprise: interrupted; nothing was written\n");
        return exit_stopped + stopped.signal;
    }
}

}  // namespace reprise::cli

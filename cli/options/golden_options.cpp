#include "cli/options/golden_options.h"

#include <CLI/CLI.hpp>

namespace reprise::cli {

namespace {

constexpr const char* paths_help =
    "Scenarios, goldens, or folders with what is below them (default: scenarios, or this folder)";

/// Names may be many; other options take the last word, as everywhere.
void add_paths(CLI::App& command, std::vector<std::string>& paths) {
    command.add_option("paths", paths, paths_help)
        ->type_name("PATH")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_jobs(CLI::App& command, std::size_t& jobs) {
    command.add_option("-j,--jobs", jobs, "How many run at a time (default: one a core)")
        ->type_name("N")
        ->check(CLI::Range(1, 1024));
}

void add_keep(CLI::App& command, std::string& keep) {
    command
        .add_option("--keep",
                    keep,
                    "Folder for the traces that goldens were made from, by content: with them, "
                    "test names the exact tick and field of a change")
        ->type_name("DIR");
}

void add_test(CLI::App& app, TestOptions& test) {
    CLI::App& command =
        *app.add_subcommand("test", "Run scenarios and compare them with their goldens");
    add_paths(command, test.paths);
    add_jobs(command, test.jobs);
    command.add_option("--junit", test.junit, "Also write the results as JUnit XML")
        ->type_name("FILE.xml");
    command
        .add_option("-o,--output",
                    test.output,
                    "Folder for the traces of cases that fail (default reprise-test)")
        ->type_name("DIR");
    add_keep(command, test.keep);
    add_drivers(command, test);
    command.add_flag("--checks",
                     test.checks,
                     "Verdicts and events only: other numbers do not count, and a scenario without "
                     "a golden passes when its own checks hold");
    command
        .add_option("--repeat",
                    test.repeat,
                    "Run each so often: one history, or the first difference of two runs")
        ->type_name("N")
        ->check(CLI::Range(1, 100'000));
    command.add_flag("--list", test.list, "Say which cases there are, and run none");
    command.footer(
        "A golden lies beside its scenario: cut_in.golden, and cut_in@NAME.golden for a case.\n"
        "Scenarios with a car of another program are run with --driver; their checks count.\n"
        "Exit status: 0 all equal; 1 changed, failed, not run, or no golden; 2 bad input, or a run "
        "broke;\n"
        "3 nondeterministic: two runs of one candidate differ.\n"
        "Examples: reprise test scenarios --junit results.xml\n"
        "          reprise test my_scenarios --checks --repeat 100\n"
        "          reprise test my_scenarios --driver ego='python3 my_driver.py'");
}

void add_accept(CLI::App& app, AcceptOptions& accept, std::vector<std::string>& assignments) {
    CLI::App& command = *app.add_subcommand(
        "accept", "Make what named scenarios do now their goldens, with a reason");
    command.add_option("scenarios", accept.names, "Scenarios or goldens, each by its name")
        ->required()
        ->type_name("SCENARIO")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option(
            "--because", accept.because, "Why the new behaviour is right; it is kept in the golden")
        ->type_name("TEXT");
    command
        .add_option("--case",
                    accept.name,
                    "Name of a case: the scenario with another town, seed, length or parameters")
        ->type_name("NAME");
    command
        .add_option("--pin",
                    accept.pins,
                    "What the golden compares, by commas: verdict, events, numbers, or names of "
                    "actors (default: as before; of a new one: numbers, which is everything)")
        ->type_name("WHAT,...")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter(',');
    add_start(command, accept.start, assignments);
    add_jobs(command, accept.jobs);
    add_keep(command, accept.keep);
    command.footer(
        "Runs each twice; takes only what fails now and is repeatable; all of them, or none.\n"
        "Exit status: 0 written, 1 nothing to accept, 2 bad input, 3 nondeterministic.\n"
        "Example: reprise accept scenarios/cut_in.lua --case near --set gap=8 --because \"first "
        "golden\"");
}

void add_list(CLI::App& app, GoldenListOptions& list) {
    CLI::App& golden = *app.add_subcommand("golden", "Look after goldens");
    golden.require_subcommand(1);
    CLI::App& command =
        *golden.add_subcommand("list", "Say which goldens there are, of what, and why");
    add_paths(command, list.paths);
    command.add_flag("--orphans", list.orphans, "Only those whose scenario is gone");
    command.footer("Exit status: 0; 1 --orphans found some; 2 a golden cannot be read.");
}

}  // namespace

void add_golden_commands(CLI::App& app,
                         TestOptions& test,
                         AcceptOptions& accept,
                         GoldenListOptions& list,
                         std::vector<std::string>& assignments) {
    add_test(app, test);
    add_accept(app, accept, assignments);
    add_list(app, list);
}

}  // namespace reprise::cli

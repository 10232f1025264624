#include "cli/options/trace_options.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"

namespace reprise::cli {

void add_verify(CLI::App& app, VerifyOptions& verify) {
    CLI::App& command =
        *app.add_subcommand("verify", "Simulate a trace again and compare every byte");
    command.add_option("trace", verify.trace, "The trace")->required()->type_name("T.mcap");
    command
        .add_option("--expect",
                    verify.expect,
                    "The chain that `info` or `verify` printed and you wrote down elsewhere: "
                    "the trace must have this one")
        ->type_name("CHAIN")
        ->check(CLI::Validator(
            [](std::string& text) -> std::string {
                const auto is_digit = [](unsigned char c) { return std::isxdigit(c) != 0; };
                if (text.size() != 32 || !std::all_of(text.begin(), text.end(), is_digit))
                    return "expected a chain of 32 hexadecimal digits, got '" + text + "'";
                return "";
            },
            ""));
    command.footer(
        "Needs nothing but the trace. What else the file holds (outcome, scenario, town, index) "
        "is\n"
        "compared, too. Exit status: 0 equal, 1 differs, 2 bad input.");
}

void add_info(CLI::App& app, InfoOptions& info) {
    CLI::App& command = *app.add_subcommand("info", "Say what is in a trace");
    command.add_option("trace", info.trace, "The trace")->required()->type_name("T.mcap");
    command.add_flag(
        "--long", info.long_form, "All lines of the build; events of long traces, too");
    command.add_flag("--json", info.json, "For programs: one JSON object");
}

void add_diff(CLI::App& app, DiffOptions& diff) {
    CLI::App& command = *app.add_subcommand("diff", "Find the first difference of two traces");
    command.add_option("expected", diff.expected, "A trace")->required()->type_name("A.mcap");
    command.add_option("found", diff.found, "Another trace")->required()->type_name("B.mcap");
    command
        .add_option("--tolerance",
                    diff.tolerance,
                    "For traces of different builds: how far recorded reals may be apart, in their "
                    "unit; of those larger than 1, as a share. Digests do not count then; events, "
                    "ids, texts and verdicts must be equal")
        ->type_name("T")
        ->check(CLI::Validator(
            [](std::string& text) -> std::string {
                char* end = nullptr;
                const double bound = std::strtod(text.c_str(), &end);
                return end != text.c_str() && *end == '\0' && bound >= 0 && bound <= 1e6
                           ? ""
                           : "expected a number of 0 or more such as 1e-6, got '" + text + "'";
            },
            ""));
    add_actor(command, diff.actor);
    command.add_flag("--json", diff.json, "For programs: one JSON object");
    command.add_flag("--all", diff.all, "Every field in which the first differing tick differs");
    command.footer(
        "Two folders of pictures: of each sensor whether its files are the same, else how far they "
        "are\napart. Exit status: 0 equal (within the tolerance), 1 different, 2 bad input.");
}

void add_recover(CLI::App& app, RecoverOptions& recover) {
    CLI::App& command = *app.add_subcommand(
        "recover", "Make a whole trace of what a crash, a full disk or damage left of one");
    command
        .add_option("damaged", recover.damaged, "What is left, such as a.mcap.partial; only read")
        ->required()
        ->type_name("IN");
    command.add_option("-o,--output", recover.output, "Where the whole trace goes")
        ->required()
        ->type_name("OUT.mcap");
    command.footer(
        "Keeps every tick up to the first that is not sound; a running simulation writes whole\n"
        "chunks of 64 ticks. Exit status: 0 nothing was lost, 1 nothing can be recovered,\n"
        "2 bad input, 3 recovered with loss.\n"
        "Example: reprise recover a.mcap.partial -o a.mcap");
}

CLI::Option& add_level(CLI::App& command,
                       std::string& level,
                       const std::vector<std::string>& words) {
    return *command
                .add_option("--level",
                            level,
                            "How much of each tick is kept: inputs (what was driven by hand, and "
                            "digests), core (all but the traffic), keyed (the traffic once a "
                            "second)" +
                                std::string(words.front() == "full" ? ", full (default)" : ""))
                ->type_name("LEVEL")
                ->check(one_of(words, "level"));
}

void add_strip(CLI::App& app, StripOptions& strip) {
    CLI::App& command = *app.add_subcommand(
        "strip", "Leave out of a trace what can be simulated again: expand brings it back");
    command.add_option("trace", strip.trace, "The trace")->required()->type_name("T.mcap");
    command.add_option("-o,--output", strip.output, "Where the smaller trace goes")
        ->required()
        ->type_name("S.mcap");
    add_level(command, strip.level, {"inputs", "core", "keyed"}).required();
    command.footer(
        "verify and diff work on the smaller trace; render needs the traffic.\n"
        "Example: reprise strip a.mcap -o small.mcap --level inputs");
}

void add_expand(CLI::App& app, ExpandOptions& expand) {
    CLI::App& command = *app.add_subcommand(
        "expand", "Simulate again what strip left out of a trace, checking every tick");
    command.add_option("trace", expand.trace, "The stripped trace")
        ->required()
        ->type_name("S.mcap");
    command.add_option("-o,--output", expand.output, "Where the full trace goes")
        ->required()
        ->type_name("T.mcap");
    command.footer(
        "The result is, byte for byte, the trace before it was stripped. Exit status: 0 done, 1 a\n"
        "tick came out differently (nothing is written), 2 bad input.");
}

}  // namespace reprise::cli

#include "cli/options/discover_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"

namespace reprise::cli {

void add_list(CLI::App& app, ListOptions& list) {
    CLI::App& command = *app.add_subcommand("list", "What a scenario can name");
    const std::vector<std::string> nouns{
        "models", "walkers", "props", "weathers", "words", "checks", "scenarios", "towns", "lanes"};
    command.add_option("noun", list.noun, "One of " + joined(nouns))
        ->required()
        ->type_name("NOUN")
        ->check(one_of(nouns, "list"));
    command
        .add_option("text",
                    list.words,
                    "Only rows with this text; of words the one of that name; of lanes the town "
                    "comes first")
        ->type_name("[TOWN] [TEXT]")
        ->expected(0, 2);
    command.add_flag("--json", list.json, "For programs");
    command.add_flag(
        "--all", list.all, "lanes: also those inside junctions, crossings and walking areas");
    command.add_flag("--luals",
                     list.luals,
                     "words: as annotations for editors with the Lua language server (LuaLS)");
    command.add_flag("--markdown", list.markdown, "words: as the page docs/words.md");
    command.footer(
        "Examples: reprise list models taxi\n"
        "          reprise list lanes town1 driving\n"
        "          reprise list words spawn\n"
        "          reprise list words --luals > reprise.d.lua   # beside your scenarios");
}

void add_new(CLI::App& app, NewOptions& fresh) {
    CLI::App& command = *app.add_subcommand("new", "Write a first scenario to start from");
    command.add_option("name", fresh.name, "Of the scenario and its file")
        ->required()
        ->type_name("NAME");
    command.add_option("--town", fresh.town, "Where it is set (default town1)")->type_name("TOWN");
    command.footer(
        "Writes NAME.lua, which runs and passes as it stands, and overwrites nothing.\n"
        "Example: reprise new first_steps && reprise run first_steps.lua");
}

void add_lint(CLI::App& app, LintOptions& lint) {
    CLI::App& command =
        *app.add_subcommand("lint", "Look for mistakes in scenarios: read them, and try them");
    command.add_option("files", lint.files, "Scenarios")
        ->required()
        ->type_name("SCENARIO.lua")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--town", lint.town, "As that of run: where lanes are looked up")
        ->type_name("NET");
    command
        .add_option("--for", lint.seconds, "Try no more than this much simulated time (default 60)")
        ->type_name("SECONDS")
        ->check(CLI::PositiveNumber);
    command.add_flag(
        "--read-only", lint.read_only, "Only read them, as editors do while one types");
    command.footer(
        "One line each: FILE:LINE: what is wrong. Reading finds unknown words, keys, lanes, models "
        "and\n"
        "parameters, also where no run comes along; trying finds what ends a run, and checks that "
        "never\n"
        "had anything to look at. Nothing is written.\n"
        "Exit status: 0 nothing found, 2 something found.\n"
        "Example: reprise lint scenarios/*.lua");
}

}  // namespace reprise::cli

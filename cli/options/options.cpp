#include "cli/options/options.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"
#include "world/check.h"
#include "world/fingerprint.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

std::string version_text() {
    std::string text;
    for (const auto& [key, value] : world::build_fingerprint())
        text += key + std::string(key.size() < 13 ? 13 - key.size() : 1, ' ') + value + "\n";
    text.pop_back();
    return text;
}

/// CLI11 would only say that a command is missing.
void check_command(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    if (word.empty() || word.starts_with('-') ||
        std::find(names.begin(), names.end(), word) != names.end())
        return;
    throw CLI::ExtrasError("no command '" + word + "'" + world::did_you_mean(word, names) +
                               "; there are " + joined(names),
                           CLI::ExitCodes::ExtrasError);
}

/// " (did you mean '--ticks'?)" for the first word that looks like an option and is none of its
/// command's.
std::string option_meant(const CLI::App& app, int argc, char** argv) {
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty())
        command = command->get_subcommands().front();
    std::vector<std::string> names;
    for (const CLI::Option* option : command->get_options())
        for (const std::string& name : option->get_lnames())
            names.push_back("--" + name);
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const std::string name = word.substr(0, word.find('='));
        if (name.starts_with("--") && std::find(names.begin(), names.end(), name) == names.end())
            return world::did_you_mean(name, names);
    }
    return "";
}

/// A name that is missing in a list, as in rgb,,depth: CLI11 drops it, and nobody is told.
void check_lists(const CLI::App& app, int argc, char** argv) {
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty())
        command = command->get_subcommands().front();
    const CLI::Option* list = nullptr;  // whose names the words are
    for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
        std::string text = argv[i];
        if (text.starts_with('-')) {
            const std::size_t split = text.find('=');
            list = command->get_option_no_throw(text.substr(0, split));
            if (list != nullptr && list->get_delimiter() == '\0')
                list = nullptr;
            text = split == std::string::npos ? "" : text.substr(split + 1);
        }
        if (list == nullptr || text.empty())
            continue;
        const char comma = list->get_delimiter();
        if (text.front() == comma || text.back() == comma ||
            text.find(std::string(2, comma)) != std::string::npos)
            throw CLI::ValidationError(
                list->get_name(),
                "between commas, or beside one, nothing stands in '" + text + "'");
    }
}

}  // namespace

struct CommandLine::App {
    CLI::App app{
        "Reprise: runs scripted drives in live traffic, records every tick, proves that they "
        "replay\n"
        "bit for bit, and renders what the sensors saw under any weather.",
        "reprise"};
    std::vector<std::string> assignments;
    std::vector<std::string> accept_assignments;
    std::vector<std::string> branch_assignments;
    RenderWords render_words;
    std::string drive_size;
};

CommandLine::~CommandLine() = default;

CommandLine::CommandLine() : app_(std::make_unique<App>()) {
    CLI::App& app = app_->app;
    app.require_subcommand(1);
    app.set_version_flag("--version", version_text());
    app.get_formatter()->column_width(28);
    // The last word counts, as in every shell alias.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    add_new(app, fresh);
    add_list(app, list);
    add_lint(app, lint);
    add_run(app, run, app_->assignments);
    add_drive(app, drive, app_->drive_size);
    add_verify(app, verify);
    add_info(app, info);
    add_diff(app, diff);
    add_recover(app, recover);
    add_strip(app, strip);
    add_expand(app, expand);
    add_branch(app, branch, app_->branch_assignments);
    add_serve(app, serve);
    add_render(app, render, app_->render_words);
    add_dataset(app, dataset);
    add_tool_commands(app, tools);
    add_town_commands(app, town);
    add_golden_commands(app, test, accept, golden_list, app_->accept_assignments);
}

namespace {

/// A shell's variable that is not set: whatever it was to say, silence is not it.
void check_not_empty(const CLI::App& app) {
    for (const CLI::Option* option : app.get_options())
        if (const auto& said = option->results();
            !option->get_positional() && std::find(said.begin(), said.end(), "") != said.end())
            throw CLI::ValidationError(option->get_name(),
                                       "expected " + option->get_type_name() + ", got ''");
    for (const CLI::App* command : app.get_subcommands())
        check_not_empty(*command);
}

}  // namespace

std::optional<int> CommandLine::parse(int argc, char** argv) {
    CLI::App& app = app_->app;
    try {
        check_command(app, argc > 1 ? argv[1] : "");
        app.parse(argc, argv);
        check_lists(app, argc, argv);
        for (const std::string& assignment : app_->assignments)
            run.parameters.push_back(split_assignment(assignment));
        for (const std::string& assignment : app_->branch_assignments)
            branch.parameters.push_back(split_assignment(assignment));
        for (const std::string& assignment : app_->accept_assignments)
            accept.start.parameters.push_back(split_assignment(assignment));
        finish_drive(app_->drive_size, drive);
        finish_render(app, app_->render_words, render);
        finish_dataset(app, dataset);
        check_not_empty(app);  // behind what says more
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0)
            return app.exit(error);
        const bool extra = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
        const std::string text =
            error.what() + (extra ? option_meant(app, argc, argv) : std::string());
        std::fprintf(
            stderr, "reprise: %s (reprise --help says more)\n", world::printable(text).c_str());
        return 2;
    }
    command = app.get_subcommands().front()->get_name();
    return std::nullopt;
}

}  // namespace reprise::cli

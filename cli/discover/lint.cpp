#include "cli/discover/lint.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "cli/town/towns.h"
#include "kernel/kernel.h"
#include "scripting/lint.h"
#include "scripting/lua/tokens.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/check_result.h"
#include "world/lanes/density.h"
#include "world/recording.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using scripting::Finding;

constexpr double longest_try = 60;    // [s] of simulated time
constexpr std::uint64_t too_few = 2;  // ticks of a run that did something

/// A message of ours, "cut_in.lua:12: spawn: ...", in its two parts. Line 0: it names none.
Finding parted(const std::string& message, const std::string& script) {
    const std::string start = script + ":";
    if (message.rfind(start, 0) != 0)
        return {0, message};
    const std::size_t end = message.find_first_not_of("0123456789", start.size());
    const bool has_line = end != std::string::npos && end > start.size() && message[end] == ':';
    const std::size_t text = message.find_first_not_of(' ', has_line ? end + 1 : start.size());
    return {has_line ? static_cast<std::uint32_t>(std::stoul(message.substr(start.size()))) : 0,
            text == std::string::npos ? message : message.substr(text)};
}

/// Does it speak of actors that were there before? Only `reprise branch` can run it then.
bool is_what_if(const std::string& source) {
    scripting::Tokens tokens(source);
    scripting::Token last;
    for (scripting::Token token = tokens.next(); token.kind != scripting::Token::Kind::end;
         last = token, token = tokens.next())
        if (last.kind == scripting::Token::Kind::name && last.spelling == "actor" &&
            (token.spelling == "(" || token.kind == scripting::Token::Kind::text))
            return true;
    return false;
}

/// What a run of it shows, tick by tick, without a trace.
void try_run(world::Recording& recording, double seconds, std::vector<Finding>& findings) {
    const std::string script = recording.episode.scenario_path;
    const auto most =
        static_cast<std::uint64_t>(seconds * 1e9 / static_cast<double>(recording.episode.step_ns));
    try {
        kernel::Kernel kernel(recording);
        std::uint64_t ticks = 0;
        for (; !kernel.finished() && ticks < most; ++ticks)
            kernel.step({});
        if (!kernel.finished())
            return;  // what the end would decide is open
        if (ticks <= too_few)
            findings.push_back(
                {0,
                 fmt::format(
                     "the run ends at once, in tick {}: {}", ticks, kernel.outcome().reason)});
        for (const world::CheckResult& check : kernel.checks())
            if (check.status == world::CheckResult::Status::not_evaluated)
                findings.push_back(
                    {check.line, fmt::format("the check '{}' had nothing to look at", check.name)});
    } catch (const world::Error& error) {
        findings.push_back(parted(error.what(), script));
    }
}

std::vector<Finding> findings_of(const std::string& file, const LintOptions& options) {
    std::vector<Finding> findings;
    world::Recording recording;
    const std::string script = fs::path(file).filename().string();
    try {
        recording.episode = scripting::load_episode(file, {options.town, {}, {}, {}});
    } catch (const world::Error& error) {
        return {parted(error.what(), script)};
    }
    const bool what_if = is_what_if(recording.episode.scenario);
    bool has_town = false;
    try {
        towns::Network network = load_town(recording.episode.town, file);
        recording.town = towns::read_town(network);
        recording.network = std::move(network.xml);
        recording.episode.town = network.name;
        world::settle_cars(recording.episode, recording.town);
        has_town = true;
    } catch (const world::Error& error) {
        findings.push_back({0, error.what()});
    }
    // A what-if takes the town as it is: which one, its file does not say.
    const bool knows_lanes = has_town && (!what_if || options.town);
    for (Finding& finding :
         scripting::lint(recording.episode.scenario, knows_lanes ? &recording.town : nullptr))
        findings.push_back(std::move(finding));
    if (has_town && !what_if && !options.read_only) {
        std::vector<Finding> tried;
        try_run(recording, options.seconds.value_or(longest_try), tried);
        for (Finding& finding : tried) {
            // What reading found there the run found again.
            const bool known =
                std::any_of(findings.begin(), findings.end(), [&](const Finding& other) {
                    return other.line == finding.line && finding.line != 0;
                });
            if (!known)
                findings.push_back(std::move(finding));
        }
    }
    std::stable_sort(findings.begin(), findings.end(), [](const Finding& a, const Finding& b) {
        return a.line < b.line;
    });
    return findings;
}

}  // namespace

int lint(const LintOptions& options) {
    bool clean = true;
    for (const std::string& file : options.files) {
        const std::vector<Finding> findings = findings_of(file, options);
        for (const Finding& finding : findings)
            say("{}{}: {}\n",
                file,
                finding.line == 0 ? "" : ":" + std::to_string(finding.line),
                finding.message);
        if (findings.empty())
            say("{}: nothing found\n", file);
        clean = clean && findings.empty();
    }
    return clean ? exit_good : exit_bad_input;
}

}  // namespace reprise::cli

#include "cli/golden/golden_case.h"

#include <cctype>
#include <fstream>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "cli/process/reproduce.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* scenario_ending = ".lua";
constexpr const char* golden_ending = ".golden";

bool is_file(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

fs::path with_ending(const fs::path& path, const std::string& ending) {
    return path.string() + ending;
}

/// A Lua file's text without its comments.
std::string code_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::string source((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    for (std::size_t at = 0; (at = source.find("--", at)) != std::string::npos;) {
        const bool block = source.compare(at, 4, "--[[") == 0;
        const std::size_t end = block ? source.find("]]", at) : source.find('\n', at);
        source.erase(at, end == std::string::npos ? end : end - at + (block ? 2 : 0));
    }
    return source;
}

/// Whether a scenario may have a car that another program drives: it says the driver's name.
bool may_be_external(const fs::path& scenario) {
    const std::string source = code_of(scenario);
    return source.find("'external'") != std::string::npos ||
           source.find("\"external\"") != std::string::npos;
}

/// The case that a golden of this name belongs to. A scenario may have an @ in its own name.
GoldenCase case_of_golden(const fs::path& golden) {
    GoldenCase found;
    found.golden = golden;
    const fs::path folder = golden.parent_path();
    const std::string stem = golden.stem().string();
    found.scenario = folder / (stem + scenario_ending);
    if (const auto at = stem.rfind('@'); !is_file(found.scenario) && at != std::string::npos) {
        found.scenario = folder / (stem.substr(0, at) + scenario_ending);
        found.name = stem.substr(at + 1);
    }
    if (!is_file(found.scenario))
        found.state = GoldenCase::State::orphan;
    else if (!is_file(golden))
        found.state = may_be_external(found.scenario) ? GoldenCase::State::external
                                                      : GoldenCase::State::no_golden;
    return found;
}

/// Whether a Lua file could return a scenario: without comments, it says the word.
bool may_be_scenario(const fs::path& path) {
    const std::string source = code_of(path);
    for (std::size_t at = 0; (at = source.find("scenario", at)) != std::string::npos; at += 8) {
        const auto is_word = [&](std::size_t i) {
            return i < source.size() &&
                   (std::isalnum(static_cast<unsigned char>(source[i])) != 0 || source[i] == '_');
        };
        if ((at == 0 || !is_word(at - 1)) && !is_word(at + 8))
            return true;
    }
    return false;
}

/// Collects cases by golden, so that what is named twice runs once.
class Collector {
  public:
    void add(const std::string& text) {
        const fs::path path = fs::path(text).lexically_normal();
        std::error_code ignored;
        if (fs::is_directory(path, ignored))
            add_folder(path);
        else if (path.extension() == golden_ending && is_file(path))
            insert(case_of_golden(path));
        else if (path.extension() == scenario_ending && is_file(path))
            add_scenario(path);
        else if (is_file(with_ending(path, golden_ending)))
            insert(case_of_golden(with_ending(path, golden_ending)));
        else if (is_file(with_ending(path, scenario_ending)))
            add_scenario(with_ending(path, scenario_ending));
        else if (fs::exists(path, ignored))
            throw world::Error(text + ": neither a scenario (.lua), nor a golden, nor a folder");
        else
            throw world::Error(text + ": there is no such scenario, golden or folder");
    }

    FoundCases take() {
        FoundCases found;
        for (auto& [key, one] : cases_)
            found.cases.push_back(std::move(one));
        found.notes = std::move(notes_);
        return found;
    }

  private:
    void insert(GoldenCase one) {
        std::error_code ignored;
        cases_.emplace(fs::weakly_canonical(one.golden, ignored).string(), std::move(one));
    }

    void add_scenario(const fs::path& scenario) {
        if (!may_be_scenario(scenario))
            throw world::Error(scenario.string() + ": not a scenario: it never says `scenario`");
        const fs::path folder = scenario.parent_path();
        std::vector<fs::path> goldens;
        for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder))
            if (entry.path().extension() == golden_ending)
                goldens.push_back(folder / entry.path().filename());
        if (!insert_cases(scenario, goldens))
            insert(case_of_golden(fs::path(scenario).replace_extension(golden_ending)));
    }

    bool insert_cases(const fs::path& scenario, const std::vector<fs::path>& goldens) {
        bool any = false;
        for (const fs::path& golden : goldens) {
            GoldenCase one = case_of_golden(golden);
            if (one.scenario != scenario)
                continue;
            insert(std::move(one));
            any = true;
        }
        return any;
    }

    void add_folder(const fs::path& folder) {
        std::map<fs::path, bool> scenarios;  // to whether it has a golden
        std::vector<fs::path> goldens;
        const auto options = fs::directory_options::skip_permission_denied;
        for (auto entry = fs::recursive_directory_iterator(folder, options);
             entry != fs::recursive_directory_iterator();
             ++entry) {
            const fs::path path = entry->path().lexically_normal();
            if (entry->is_directory() && path.filename().string().starts_with('.'))
                entry.disable_recursion_pending();
            else if (path.extension() == scenario_ending && is_file(path))
                scenarios[path] = false;
            else if (path.extension() == golden_ending && is_file(path))
                goldens.push_back(path);
        }
        for (const fs::path& golden : goldens) {
            GoldenCase one = case_of_golden(golden);
            if (const auto at = scenarios.find(one.scenario); at != scenarios.end())
                at->second = true;
            insert(std::move(one));
        }
        for (const auto& [scenario, has_golden] : scenarios) {
            if (has_golden)
                continue;
            if (may_be_scenario(scenario))
                insert(case_of_golden(fs::path(scenario).replace_extension(golden_ending)));
            else
                notes_.push_back(scenario.string() + " is not a scenario: passed over");
        }
    }

    std::map<std::string, GoldenCase> cases_;
    std::vector<std::string> notes_;
};

/// As in cli/town/towns.cpp: anything else is a town's name.
bool is_network_path(const std::string& town) {
    return town.find('/') != std::string::npos || town.ends_with(".xml") || town.ends_with(".gz");
}

}  // namespace

std::string GoldenCase::label() const {
    return fs::path(golden).replace_extension().string();
}

FoundCases find_cases(const std::vector<std::string>& paths) {
    if (paths.empty())
        return find_cases({fs::is_directory("scenarios") ? "scenarios" : "."});
    Collector collector;
    for (const std::string& path : paths) {
        try {
            collector.add(path);
        } catch (const fs::filesystem_error& error) {
            throw world::Error(path + ": " + error.code().message());
        }
    }
    return collector.take();
}

GoldenCase named_case(const std::string& text, const std::string& name) {
    if (name.find_first_not_of(
            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-") !=
        std::string::npos)
        throw world::Error("--case '" + name + "': letters, digits, _, - and . only");
    const fs::path path = fs::path(text).lexically_normal();
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        throw world::Error(text + ": a folder; accept takes scenarios and goldens by their names");
    GoldenCase found;
    if (path.extension() == scenario_ending || is_file(with_ending(path, scenario_ending))) {
        const fs::path scenario =
            path.extension() == scenario_ending ? path : with_ending(path, scenario_ending);
        if (!is_file(scenario))
            throw world::Error(text + ": there is no such scenario");
        const std::string stem = scenario.stem().string() + (name.empty() ? "" : "@" + name);
        found.scenario = scenario;
        found.name = name;
        found.golden = scenario.parent_path() / (stem + golden_ending);
        found.state =
            is_file(found.golden) ? GoldenCase::State::ready : GoldenCase::State::no_golden;
        return found;
    }
    if (!name.empty())
        throw world::Error(text + ": --case goes with a scenario (.lua)");
    found =
        case_of_golden(path.extension() == golden_ending ? path : with_ending(path, golden_ending));
    if (found.state == GoldenCase::State::orphan)
        throw world::Error(text + ": there is no scenario " + found.scenario.string());
    return found;
}

std::string stored_town(const std::string& town, const fs::path& golden) {
    std::error_code ignored;
    const bool plain_file = !is_network_path(town) && is_file(town);
    if (fs::path(town).is_absolute() || (!is_network_path(town) && !plain_file))
        return town;
    const fs::path folder = fs::absolute(golden).parent_path();
    const std::string stored =
        fs::absolute(town).lexically_normal().lexically_relative(folder.lexically_normal());
    return is_network_path(stored) ? stored : "./" + stored;
}

std::vector<std::string> run_words(const GoldenCase& tested,
                                   const replay::GivenSetup& given,
                                   const fs::path& trace,
                                   const DriverOptions& drivers) {
    const std::string scenario = tested.scenario.string();
    std::vector<std::string> words{"run", scenario.starts_with('-') ? "./" + scenario : scenario};
    const auto add = [&](const std::string& option, const std::string& value) {
        if (!value.empty())
            words.insert(words.end(), {option, value});
    };
    std::string town = given.town;
    if (is_network_path(town) && !fs::path(town).is_absolute())
        town = (tested.golden.parent_path() / town).lexically_normal().string();
    // A bare file name without an ending would be looked up as a town's name first.
    add("--town", is_network_path(town) || town == given.town ? town : "./" + town);
    add("--seed", given.seed);
    add("--for", given.seconds);
    for (const auto& [key, value] : given.parameters)
        add("--set", key + "=" + value);
    for (const std::string& driver : drivers.drivers)
        add("--driver", driver);
    if (drivers.driver_timeout)
        add("--driver-timeout", fmt::format("{}", *drivers.driver_timeout));
    add("-o", trace.string());
    return words;
}

std::string command_line(const std::vector<std::string>& words) {
    std::string text = "reprise";
    for (const std::string& word : words)
        text += " " + shell_word(word);
    return text;
}

std::string accept_command(const GoldenCase& tested) {
    std::string text = "reprise accept " + shell_path(tested.scenario);
    if (!tested.name.empty())
        text += " --case " + shell_word(tested.name);
    return text + " --because \"...\"";
}

}  // namespace reprise::cli

// What there is, and how to begin: list, new, lint, run --watch.
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <poll.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

json listed(const std::vector<std::string>& words) {
    std::vector<std::string> all{"list"};
    all.insert(all.end(), words.begin(), words.end());
    all.emplace_back("--json");
    const Folder folder;
    const Result result = reprise(all, folder.path());
    EXPECT_EQ(result.code, 0) << result.out;
    return json::parse(result.out);
}

TEST(List, TellsWhatAScenarioCanNameFromAnyFolder) {
    const Folder folder;
    for (const auto& [noun, row] : {std::pair("models", "sedan +passenger +4\\.70 +1\\.82"),
                                    std::pair("walkers", "child +child +1\\."),
                                    std::pair("weathers", "clear_noon +paper +1\\.00"),
                                    std::pair("words", "ego:set_speed +\\(speed: number"),
                                    std::pair("checks", "check\\.never"),
                                    std::pair("towns", "town1 +[0-9.]+ "),
                                    std::pair("scenarios", "cut_in +.*cut_in\\.lua +town1")}) {
        const Result result = reprise({"list", noun}, folder.path());
        EXPECT_EQ(result.code, 0) << result.out;
        EXPECT_THAT(result.out, ContainsRegex(row)) << noun;
        EXPECT_THAT(result.out, Not(HasSubstr(" \n"))) << "no blanks at the end of a line";
        EXPECT_GT(listed({noun}).size(), 1U) << noun;
    }
    EXPECT_THAT(folder.files(), IsEmpty());
}

TEST(List, SaysWhichLaneIsASidewalkAndWhoItsNeighboursAre) {
    bool sidewalk = false;
    for (const json& lane : listed({"lanes", "town1"})) {
        const std::string name = lane["name"];
        EXPECT_NE(name.front(), ':') << "those inside junctions are for --all";
        if (lane["kind"] == "driving") {
            EXPECT_GT(lane["limit_kmh"], 20);
        }
        if (name == "b1_b2_0") {
            sidewalk = true;
            EXPECT_EQ(lane["kind"], "sidewalk");
            EXPECT_TRUE(lane["limit_kmh"].is_null());
        }
    }
    EXPECT_TRUE(sidewalk);
    EXPECT_GT(listed({"lanes", "town1", "--all"}).size(), listed({"lanes", "town1"}).size());
    for (const json& lane : listed({"lanes", "town1", "sidewalk"}))
        EXPECT_EQ(lane["kind"], "sidewalk");
    const json straight = listed({"lanes", "straight", "driving"});
    ASSERT_FALSE(straight.empty());
    bool between = false;
    for (const json& lane : straight)
        between = between || (lane["left"].is_string() && lane["right"].is_string());
    EXPECT_TRUE(between) << "the middle one of three";
}

TEST(List, TellsOneWordWhole) {
    const Result result = reprise({"list", "words", "spawn"});
    EXPECT_EQ(result.code, 0);
    EXPECT_THAT(result.out, HasSubstr("spawn(options: SpawnOptions): Actor\n"));
    EXPECT_THAT(result.out, ContainsRegex("  lane_changes\\? +boolean"));
    EXPECT_EQ(reprise({"list", "words", "ego:lane"}).out, reprise({"list", "words", "lane"}).out);
}

TEST(List, SaysWhatThereIsToList) {
    for (const auto& [words, said] :
         {std::pair(std::vector<std::string>{"list", "modles"},
                    "no list 'modles' (did you mean 'models'?); there are models, walkers, "),
          std::pair(std::vector<std::string>{"list", "lanes"}, "of which town?"),
          std::pair(std::vector<std::string>{"list", "lanes", "twn1"}, "did you mean 'town1'?"),
          std::pair(std::vector<std::string>{"list", "models", "xyzzy"}, "rows holds 'xyzzy'"),
          std::pair(std::vector<std::string>{"list", "models", "--luals"}, "--luals")}) {
        const Result result = reprise(words);
        EXPECT_EQ(result.code, 2) << result.out;
        EXPECT_THAT(result.out, HasSubstr(said));
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    }
}

/// The page is made of the table: `reprise list words --markdown > docs/words.md`.
TEST(Words, HaveAPageThatIsWhatTheProgramSays) {
    EXPECT_EQ(read_file(source("docs/words.md")), reprise({"list", "words", "--markdown"}).out);
}

/// The page for people is written by hand: each word of it is one, and each word is in it.
TEST(Words, AreAllOnThePageOfTheVocabulary) {
    const std::string page = read_file(source("scripting/vocabulary.md"));
    for (const json& row : listed({"words"})) {
        std::string word = row["word"];
        word.erase(0, word.rfind(':') + 1);
        EXPECT_THAT(page, ContainsRegex("[^a-z_]" + word + "[^a-z_]")) << "scripting/vocabulary.md";
    }
}

TEST(Words, OfThePageOfTheVocabularyExist) {
    std::string known;
    for (const json& row : listed({"words"}))
        known += " " + row["word"].get<std::string>() + "\n";
    std::istringstream page(read_file(source("scripting/vocabulary.md")));
    for (std::string line; std::getline(page, line);) {
        // The first cell of a row, between its backquotes: `ego:x()`, `wait(seconds)`,
        // `set_speed_kmh`.
        if (line.rfind("| `", 0) != 0)
            continue;
        const std::string cell = line.substr(0, line.find(" | ", 2));
        for (std::size_t from = 0; (from = cell.find('`', from)) != std::string::npos;) {
            const std::size_t end = cell.find('`', from + 1);
            std::string word = cell.substr(from + 1, end - from - 1);
            word.resize(std::min(word.find_first_of("({' "), word.size()));
            word.erase(0, word.rfind(':') + 1);
            from = end + 1;
            if (word.empty())
                continue;  // other arguments of the word before it
            EXPECT_THAT(known, ContainsRegex("[ :.]" + word.substr(word.rfind('.') + 1) + "\n"))
                << line;
        }
    }
}

/// Of what the language server reads: Lua, and of each comment its tag.
TEST(Words, AreDeclaredForEditors) {
    const Folder folder;
    EXPECT_EQ(typed("reprise list words --luals > words.lua && lua5.4 words.lua", folder).code, 0)
        << "it is Lua, and does nothing";
    const std::string text = read_file(folder / "words.lua");
    EXPECT_THAT(text, testing::StartsWith("---@meta\n"));
    for (const auto& row : nlohmann::json::parse(reprise({"list", "words", "--json"}).out)) {
        std::string word = row["word"];
        word.erase(0, word.find_last_of(".:") + 1);
        EXPECT_THAT(text, ContainsRegex("function [A-Za-z_.:]*" + word + "\\(")) << row;
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("---@"))
            continue;
        EXPECT_THAT(line,
                    ContainsRegex("^---@(meta|alias|class|field|param|return|type|overload)"));
    }
}

TEST(New, WritesAScenarioThatRunsPassesAndHasNoMistake) {
    const Folder folder;
    for (const char* town : {"town1", "town2", "straight"}) {
        const std::string name = std::string("in_") + town;
        EXPECT_EQ(reprise({"new", name, "--town", town}, folder.path()).code, 0);
        const Result run = reprise({"run", name + ".lua"}, folder.path());
        EXPECT_EQ(run.code, 0) << run.out;
        EXPECT_THAT(run.out, HasSubstr("passed: scenario ended"));
        const Result lint = reprise({"lint", name + ".lua"}, folder.path());
        EXPECT_EQ(lint.code, 0) << lint.out;
    }
}

TEST(New, OverwritesNothing) {
    const Folder folder;
    write_file(folder / "mine.lua", "my work");
    const Result result = reprise({"new", "mine"}, folder.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("'mine.lua' is there already"));
    EXPECT_EQ(read_file(folder / "mine.lua"), "my work");
    for (const char* name : {"my-test", "a.txt", ""})
        EXPECT_EQ(reprise({"new", name}, folder.path()).code, 2) << name;
    EXPECT_EQ(reprise({"new", "a", "--town", "twn1"}, folder.path()).code, 2);
    EXPECT_EQ(folder.files().size(), 1U);
}

/// What `reprise lint` says of a scenario, and that it leaves nothing behind.
Result linted(const std::string& source, const std::vector<std::string>& options = {}) {
    const Folder folder;
    write_file(folder / "a.lua", source);
    std::vector<std::string> words{"lint", "a.lua"};
    words.insert(words.end(), options.begin(), options.end());
    Result result = reprise(words, folder.path());
    EXPECT_EQ(folder.files().size(), 1U);
    return result;
}

TEST(Lint, TellsFileAndLineOfWhatIsWrong) {
    const std::pair<const char*, const char*> cases[] = {
        {"return scenario 'a' {\n run = function(\n}", "a.lua:3: "},
        {"return scenario 'a' {\n twwn = 'town1', run = function() end }",
         "a.lua:1: scenario: unknown key"},
        {"return scenario 'a' { run = function()\n if time() > 3 then\n wiat(3) end wait(1) end }",
         "a.lua:3: no variable or function 'wiat' (did you mean 'wait'?)\n"},
        {"return scenario 'a' { run = function()\n spawn{ model = 'sedan', lane = 'b1_b2' } "
         "wait(1) end }",
         "a.lua:2: 'b1_b2' is an edge of town1: its lanes are 'b1_b2_1' (driving)"},
        {"return scenario 'a' { run = function() end }", "a.lua: the run ends at once, in tick 1"},
        {"return scenario 'a' { run = function()\n local e = spawn{ model = 'sedan' }\n"
         "check.never('x', function() return e:collided() end) wait_ticks(4) e:despawn()\n"
         "check.max('speed', function() return nil end, 3) wait(1) end }",
         "a.lua:4: the check 'speed' had nothing to look at\n"},
        {"return scenario 'a' { run = function()\n wait(1)\n local e = nil\n e.x = 3 end }",
         "a.lua:4: "},
        {"return scenario 'a' { town = 'nowhere', run = function() end }",
         "a.lua: no town 'nowhere'"},
    };
    for (const auto& [source, message] : cases) {
        const Result result = linted(source);
        EXPECT_EQ(result.code, 2) << source;
        EXPECT_THAT(result.out, HasSubstr(message)) << source;
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    }
}

/// As an import leaves it where the folder was given a name of its own. A folder without a network
/// is no town that one could have meant.
TEST(Lint, KnowsATownByItsFolderWhateverItsNetworkIsCalled) {
    const Folder folder;
    const std::filesystem::path towns = folder / "towns";
    std::filesystem::create_directories(towns / "mine");
    std::filesystem::create_directories(towns / "minx");
    std::filesystem::copy_file(source("scenarios/towns/straight/straight.net.xml"),
                               towns / "mine" / "map_of_may.net.xml");
    const auto with_town = [&](const std::string& town) {
        write_file(folder / "a.lua",
                   "return scenario 'a' { town = '" + town +
                       "', duration = 2,\n"
                       "run = function() wait(1) end }");
        return reprise({"lint", "a.lua"}, folder.path());
    };
    const Result known = with_town("mine");
    EXPECT_EQ(known.code, 0) << known.out;
    const Result empty = with_town("minx");
    EXPECT_EQ(empty.code, 2);
    EXPECT_THAT(empty.out, HasSubstr("no town 'minx' (did you mean 'mine'?)"));
}

TEST(Lint, FindsNothingInOurOwnScenarios) {
    std::vector<std::string> words{"lint"};
    for (const auto& entry : std::filesystem::directory_iterator(source("scenarios")))
        if (entry.path().extension() == ".lua")
            words.push_back(entry.path().string());
    const Result result = reprise(words);
    EXPECT_EQ(result.code, 0) << result.out;
}

/// A program that goes on, and what it says, read as it says it.
class Running {
  public:
    Running(const std::vector<std::string>& words, const std::filesystem::path& folder) {
        std::array<int, 2> pipe_ends{};
        EXPECT_EQ(pipe(pipe_ends.data()), 0);
        child_ = fork();
        if (child_ == 0) {
            dup2(pipe_ends[1], 1);
            dup2(pipe_ends[1], 2);
            close(pipe_ends[0]);
            close(pipe_ends[1]);
            std::vector<char*> argv{const_cast<char*>(REPRISE_PROGRAM)};
            for (const std::string& word : words)
                argv.push_back(const_cast<char*>(word.c_str()));
            argv.push_back(nullptr);
            if (chdir(folder.c_str()) == 0)
                execv(REPRISE_PROGRAM, argv.data());
            _exit(99);
        }
        close(pipe_ends[1]);
        output_ = pipe_ends[0];
    }

    ~Running() {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
        close(output_);
    }

    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    /// Reads on until it has said this; all that it said since the last time.
    std::string until(const std::string& text) {
        std::string said;
        while (said.find(text) == std::string::npos) {
            std::array<char, 4096> bytes{};
            const ssize_t size = read(output_, bytes.data(), bytes.size());
            if (size <= 0)
                break;
            said.append(bytes.data(), static_cast<std::size_t>(size));
        }
        return said;
    }

    /// Tells it, and returns its exit code.
    int end(int signal) {
        kill(child_, signal);
        int status = 0;
        waitpid(child_, &status, 0);
        child_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t child_ = 0;
    int output_ = -1;
};

TEST(Watch, RunsAgainWheneverTheScenarioOrAFileThatItNamesIsSaved) {
    const auto scenario = [](const std::string& reason) {
        return "return scenario 'a' { run = function() print('points.csv') wait_ticks(3) finish('" +
               reason + "') end }\n";
    };
    const Folder folder;
    write_file(folder / "points.csv", "t,x,y\n");
    write_file(folder / "a.lua", scenario("once"));
    Running running({"run", "a.lua", "--watch"}, folder.path());
    EXPECT_THAT(running.until("Ctrl-C ends it"), HasSubstr("completed: once"));
    write_file(folder / "a.lua", scenario("twice"));
    EXPECT_THAT(running.until("Ctrl-C ends it"), HasSubstr("completed: twice"));
    // As editors do who write beside it and rename.
    write_file(folder / "a.lua.new", scenario("thrice"));
    std::filesystem::rename(folder / "a.lua.new", folder / "a.lua");
    EXPECT_THAT(running.until("Ctrl-C ends it"), HasSubstr("completed: thrice"));
    write_file(folder / "points.csv", "t,x,y\n0,0,0\n");
    const std::string said = running.until("Ctrl-C ends it");
    EXPECT_THAT(said, HasSubstr("points.csv was saved"));
    EXPECT_THAT(said, HasSubstr("completed: thrice"));
    // A mistake is told, and the next save is waited for.
    write_file(folder / "a.lua", "return 3");
    EXPECT_THAT(running.until("Ctrl-C ends it"), HasSubstr("a scenario file ends with"));
    write_file(folder / "a.lua", scenario("again"));
    EXPECT_THAT(running.until("Ctrl-C ends it"), HasSubstr("completed: again"));
    EXPECT_EQ(running.end(SIGINT), 128 + SIGINT);
    EXPECT_EQ(folder.files().size(), 3U) << "a.lua, a.mcap, points.csv";
}

TEST(Watch, IsForScenarios) {
    const Folder folder;
    const Result result = reprise({"run", "none.lua", "--watch"}, folder.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("'none.lua' is not there"));
}

}  // namespace
}  // namespace reprise::test

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "process/program.h"
#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string village() {
    return source("tests/towns/village.osm");
}

TEST(TownImport, MakesAFolderAndSaysWhatItDid) {
    const Folder folder;
    const Result result =
        reprise({"town", "import", village(), "-o", "v", "--lefthand"}, folder.path());
    EXPECT_EQ(result.code, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("traffic drives on the left"));
    EXPECT_THAT(result.out, HasSubstr("v: written"));
    EXPECT_THAT(folder.files(),
                ElementsAre("v/import.txt", "v/village.net.xml", "v/village.place.xml"));
    EXPECT_THAT(result.out, HasSubstr(read_file(folder / "v/import.txt")));
}

TEST(TownImport, RunsInTheFolderAndInTheMapItself) {
    const Folder folder;
    EXPECT_EQ(reprise({"town", "import", village(), "-o", "v"}, folder.path()).code, 0);
    const std::string scenario = source("scenarios/free_drive.lua");
    const Result in_folder =
        reprise({"run", scenario, "--town", "v", "--for", "2", "-o", "a.mcap"}, folder.path());
    EXPECT_EQ(in_folder.code, 0) << in_folder.out;
    const Result in_map = reprise(
        {"run", scenario, "--town", village(), "--for", "2", "-o", "b.mcap"}, folder.path());
    EXPECT_EQ(in_map.code, 0) << in_map.out;
    EXPECT_THAT(in_map.out, HasSubstr("village.osm: importing it"));
    const Result same = reprise({"diff", "a.mcap", "b.mcap"}, folder.path());
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_EQ(reprise({"verify", "b.mcap"}, folder.path()).code, 0);
}

TEST(TownImport, ReplacesATownOnlyWhenForced) {
    const Folder folder;
    const std::vector<std::string> words{"town", "import", village(), "-o", "v/"};
    std::filesystem::create_directory(folder / "v");
    EXPECT_EQ(reprise(words, folder.path()).code, 0) << "an empty folder is free";
    const std::string before = read_file(folder / "v/village.net.xml");
    const Result again = reprise(words, folder.path());
    EXPECT_EQ(again.code, 2);
    EXPECT_THAT(again.out, HasSubstr("--force replaces it"));
    auto forced = words;
    forced.insert(forced.end(), {"--force", "--lefthand"});
    EXPECT_EQ(reprise(forced, folder.path()).code, 0);
    EXPECT_NE(read_file(folder / "v/village.net.xml"), before);
    // What is not a town is never replaced.
    write_file(folder / "v/thesis.txt", "years of work");
    const Result other = reprise(forced, folder.path());
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(other.out, HasSubstr("not a town that was imported"));
    EXPECT_EQ(read_file(folder / "v/thesis.txt"), "years of work");
}

TEST(TownImport, HelpSaysWhatThereIs) {
    EXPECT_THAT(reprise({"town", "--help"}).out, HasSubstr("import"));
    EXPECT_THAT(reprise({"town", "import", "--help"}).out, HasSubstr("--lefthand"));
    EXPECT_EQ(reprise({"town"}).code, 2);
}

TEST(TownImport, ClearsAwayWhatAnInterruptedOneLeft) {
    const Folder folder;
    std::filesystem::create_directories(folder / "v.partial/import.work");
    write_file(folder / "v.partial/import.work/map.xodr", "half");
    EXPECT_EQ(reprise({"town", "import", village(), "-o", "v"}, folder.path()).code, 0);
    EXPECT_THAT(folder.files(),
                ElementsAre("v/import.txt", "v/village.net.xml", "v/village.place.xml"));
    // A folder of somebody else's stays.
    std::filesystem::create_directories(folder / "w.partial");
    write_file(folder / "w.partial/mine.txt", "mine");
    EXPECT_EQ(reprise({"town", "import", village(), "-o", "w"}, folder.path()).code, 2);
    EXPECT_EQ(read_file(folder / "w.partial/mine.txt"), "mine");
}

TEST(TownImport, InterruptedOneLeavesNothingAndSaysBySignal) {
    const Folder tools;
    const Folder folder;
    // Stands in for netconvert: interrupts the program whose copy called it, and would go on.
    write_file(tools / "netconvert",
               "#!/bin/sh\nread -r _ _ _ program _ </proc/$PPID/stat\nkill -TERM $program\n"
               "sleep 1000 &\nwait\n");
    std::filesystem::permissions(tools / "netconvert", std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (tools.path().string() + ":" + path).c_str(), 1);
    const Result result = reprise({"town", "import", village(), "-o", "v"}, folder.path());
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(result.code, 128 + SIGTERM);
    EXPECT_EQ(result.out, "reprise: stopped (Terminated)\n");
    EXPECT_THAT(folder.files(), ElementsAre());
}

struct Mistake {
    const char* name;
    std::vector<std::string> words;  ///< behind `town import`
    std::vector<std::string> said;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.name;
}

class TownMistakes : public testing::TestWithParam<Mistake> {};

/// One line, exit 2, no folder left behind.
TEST_P(TownMistakes, AreToldInOneLine) {
    const Folder inputs;
    const Folder folder;
    write_file(inputs / "good.osm", read_file(village()));
    write_file(inputs / "cut.osm", read_file(village()).substr(0, 2000));
    write_file(inputs / "binary.xodr",
               std::string("\x7f"
                           "ELF\0\0",
                           6));
    write_file(inputs / "zeros.osm", "");
    std::filesystem::resize_file(inputs / "zeros.osm", std::uintmax_t{3} << 30);
    write_file(inputs / "zeros.net.xml", "<net>");
    std::filesystem::resize_file(inputs / "zeros.net.xml", std::uintmax_t{3} << 30);
    std::vector<std::string> words{"town", "import"};
    for (std::string word : GetParam().words) {
        if (const auto at = word.find('@'); at != std::string::npos)
            word.replace(at, 1, inputs / "");
        words.push_back(word);
    }
    const Result result = reprise(words, folder.path());
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
    for (const std::string& text : GetParam().said)
        EXPECT_THAT(result.out, HasSubstr(text));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

INSTANTIATE_TEST_SUITE_P(
    Import,
    TownMistakes,
    testing::Values(
        Mistake{"Missing", {"@none.osm", "-o", "d"}, {"none.osm: no such file"}},
        Mistake{"CutOff",
                {"@cut.osm", "-o", "d"},
                {"cut.osm: is not as OpenStreetMap writes it: XML parsing error at line"}},
        Mistake{"Binary", {"@binary.xodr", "-o", "d"}, {"binary.xodr: is not XML"}},
        Mistake{"HugeMap", {"@zeros.osm", "-o", "d"}, {"zeros.osm: is not XML"}},
        Mistake{"HugeNetwork", {"@zeros.net.xml", "-o", "d"}, {"zeros.net.xml: has 3072 MB"}},
        Mistake{"Folder", {"@", "-o", "d"}, {"is a folder"}},
        Mistake{"Device", {"/dev/zero", "-o", "d"}, {"/dev/zero: is not a file"}},
        Mistake{"Unwritable", {"@good.osm", "-o", "/proc/d"}, {"/proc/d.partial: cannot be made"}},
        Mistake{"NoParent", {"@good.osm", "-o", "a/b"}, {"a/b.partial: cannot be made"}},
        Mistake{"NoOutput", {"@good.osm"}, {"--output"}},
        Mistake{"BadName", {"@good.osm", "-o", "d", "--name", "../x"}, {"--name ../x", "letters"}},
        Mistake{"BadGuess", {"@good.osm", "-o", "d", "--sidewalks", "gess"}, {"gess"}}),
    [](const testing::TestParamInfo<Mistake>& tested) { return tested.param.name; });

/// Puts a program in the place of netconvert.
Result import_with(const Folder& folder, const std::string& netconvert) {
    const std::filesystem::path bin = folder / "bin";
    std::filesystem::create_directory(bin);
    write_file(bin / "netconvert", "#!/bin/sh\n" + netconvert + "\n");
    std::filesystem::permissions(bin / "netconvert", std::filesystem::perms::owner_all);
    const std::string path = std::getenv("PATH");
    setenv("PATH", (bin.string() + ":" + path).c_str(), 1);
    Result result = reprise({"town", "import", village(), "-o", "d"}, folder.path());
    setenv("PATH", path.c_str(), 1);
    return result;
}

TEST(TownImport, DoesNotTrustTheExitCodeOfNetconvert) {
    struct Case {
        const char* netconvert;
        const char* said;
    };

    for (const Case& one : {
             Case{"exit 0", "netconvert made no network of it"},
             Case{"echo '<net/>' > made.net.xml", "what came out of it is no town"},
             Case{"echo 'Error: no luck'; exit 1", "netconvert refuses it: no luck"},
             Case{"kill -SEGV $$", "netconvert crashed (signal 11"},
         }) {
        const Folder folder;
        const Result result = import_with(folder, one.netconvert);
        EXPECT_EQ(result.code, 2) << one.netconvert;
        EXPECT_THAT(result.out, HasSubstr(one.said));
        EXPECT_THAT(folder.files(), ElementsAre("bin/netconvert"));
    }
}

/// What would take hours or gigabytes is refused before netconvert sees it.
TEST(TownImport, OfAnImpossibleOpenDriveMapIsShortAndSmall) {
    const Folder folder;
    const std::string map = read_file(source("tests/maps/bridge.xodr"));
    const auto refused = [&](const std::string& from, const std::string& to) {
        std::string changed = map;
        changed.replace(changed.find(from), from.size(), to);
        write_file(folder / "m.xodr", changed);
        const process::ProgramResult result =
            process::run_program({.name = REPRISE_PROGRAM,
                                  .words = {"town", "import", "m.xodr", "-o", "t"},
                                  .folder = folder.path(),
                                  .limits = {.memory = std::uint64_t{600} << 20U, .seconds = 2}});
        EXPECT_EQ(result.code, 2) << result.said;
        EXPECT_THAT(folder.files(), ElementsAre("m.xodr"));
        return result.said;
    };
    EXPECT_THAT(refused("length=\"618.451302\"", "length=\"6e9\""),
                HasSubstr("m.xodr:3: <road>: "));
    EXPECT_THAT(refused("curvature=\"0.025", "curvature=\"1e7"), HasSubstr("m.xodr:3: <arc>: "));
    EXPECT_THAT(refused("x=\"135.000000\"", "x=\"9e7\""), HasSubstr("m.xodr:3: <geometry>: "));
    std::string lanes;
    for (int i = 0; i < 100'000; ++i)
        lanes += "<lane id=\"-3\" type=\"driving\"><width a=\"3\"/></lane>";
    EXPECT_THAT(refused("</right>", lanes + "</right>"), HasSubstr("m.xodr:3: <laneSection>: "));
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<userData>";
    for (int i = 0; i < 100'000; ++i)
        deep += "</userData>";
    EXPECT_THAT(refused("</right>", deep + "</right>"), HasSubstr("nested more than 1000 deep"));
}

TEST(TownImport, OfABrokenMapStopsARun) {
    const Folder folder;
    write_file(folder / "cut.osm", "<osm><way");
    const Result result =
        reprise({"run", source("scenarios/free_drive.lua"), "--town", "cut.osm"}, folder.path());
    EXPECT_EQ(result.code, 2);
    EXPECT_THAT(result.out, HasSubstr("cut.osm: is not as OpenStreetMap writes it: "));
    EXPECT_THAT(folder.files(), ElementsAre("cut.osm"));
}

}  // namespace
}  // namespace reprise::test

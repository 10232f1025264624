#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "tests/traffic/stage.h"
#include "towns/town_reader.h"
#include "world/check.h"

namespace reprise::towns {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

/// A folder of this test's own, removed at the end.
class NetworkFiles : public ::testing::Test {
  protected:
    NetworkFiles()
        : folder_(std::filesystem::path(::testing::TempDir()) /
                  ("reprise_network_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
    }

    ~NetworkFiles() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }

    std::string message(const std::filesystem::path& path) const {
        try {
            load_network(path);
        } catch (const world::Error& error) {
            return error.what();
        }
        return "no error";
    }

    static std::string town2() { return test::own_town("town2").network.xml; }

    std::filesystem::path folder_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
    return text;
}

TEST_F(NetworkFiles, EveryBadFileIsOneClearLine) {
    struct Case {
        const char* name;
        std::string text;
        const char* expected;
    };

    const std::string own = town2();
    std::string bent = own;
    bent.insert(bent.find("shape=\"", bent.find("<lane")) + 7, "x");
    const Case cases[] = {
        {"empty.net.xml", "", "empty.net.xml:1: is empty"},
        {"blank.net.xml", " \n\n ", "blank.net.xml:1: is empty"},
        {"text.net.xml", "hello", "text.net.xml:1: is not a SUMO network"},
        {"broken.net.xml",
         "<net>\n<edge id=\"a\">\n<lane </net>",
         "broken.net.xml:3: is not a SUMO"},
        {"cut.net.xml", own.substr(0, 9000), ": is not a SUMO network"},
        {"map.net.xml",
         "<?xml version=\"1.0\"?>\n<OpenDRIVE/>",
         "map.net.xml:2: expected <net>, found <OpenDRIVE>; make a town of it: reprise town "
         "import"},
        {"street.net.xml", "<osm/>", "found <osm>; make a town of it: reprise town import"},
        {"routes.net.xml", "<routes/>", "routes.net.xml:1: expected <net>, found <routes>"},
        {"none.net.xml",
         "<net version=\"1.9\"/>",
         "none.net.xml:1: has no edge that a passenger car may use"},
        {"rail.net.xml",
         replaced(own, "disallow=\"pedestrian", "disallow=\"passenger pedestrian"),
         "has no edge that a passenger car may use"},
        {"fast.net.xml",
         replaced(own, "speed=\"13.890\"", "speed=\"fast\""),
         ": <lane>: speed=\"fast\" is not a number"},
        {"shapeless.net.xml", replaced(own, "shape=", "form="), ": <lane> has no shape"},
        {"point.net.xml", bent, "in its shape is not a point"},
        {"cut.net.xml.gz", "\x1f\x8b\x08 and no more", "is damaged or cut off"},
    };
    for (const Case& one : cases) {
        const std::string said = message(write(one.name, one.text));
        EXPECT_THAT(said, HasSubstr(one.expected)) << one.name;
        EXPECT_THAT(said, Not(HasSubstr("\n"))) << one.name;
    }
}

TEST_F(NetworkFiles, AMissingFileNamesTheOneThatWasMeant) {
    write("harbour.net.xml", town2());
    EXPECT_THAT(message(folder_ / "harbor.net.xml"),
                EndsWith("harbor.net.xml: no such file (did you mean 'harbour.net.xml'?)"));
    EXPECT_THAT(message(folder_), HasSubstr("is a folder"));
}

TEST_F(NetworkFiles, GzipHoldsTheSameNetwork) {
    const std::filesystem::path packed = folder_ / "town2.net.xml.gz";
    const std::string own = town2();
    gzFile file = gzopen(packed.c_str(), "wb");
    gzwrite(file, own.data(), static_cast<unsigned>(own.size()));
    gzclose(file);
    const Network network = load_network(packed);
    EXPECT_EQ(network.name, "town2");
    EXPECT_EQ(network.xml, own);
    EXPECT_EQ(network.notes, "");
}

/// SUMO's programs write a member for each few kilobytes.
TEST_F(NetworkFiles, GzipOfSeveralMembersHoldsThemAll) {
    const std::filesystem::path packed = folder_ / "town2.net.xml.gz";
    const std::string own = town2();
    for (std::size_t from = 0; from < own.size(); from += 20000) {
        gzFile file = gzopen(packed.c_str(), from == 0 ? "wb" : "ab");
        const std::string part = own.substr(from, 20000);
        gzwrite(file, part.data(), static_cast<unsigned>(part.size()));
        gzclose(file);
    }
    EXPECT_EQ(load_network(packed).xml, own);
    std::filesystem::resize_file(packed, std::filesystem::file_size(packed) - 20);
    EXPECT_THAT(message(packed), HasSubstr("is damaged or cut off"));
}

TEST_F(NetworkFiles, ALaneOfNoWidthIsClosedAndSaid) {
    std::string own = town2();
    const std::size_t sidewalk = own.find("allow=\"pedestrian\"", own.find("\" from=\""));
    own.replace(own.find("width=\"", sidewalk), 7, "width=\"0.00\" was=\"");
    const Network network = load_network(write("narrow.net.xml", own));
    EXPECT_THAT(network.notes, HasSubstr("narrow.net.xml: 1 lane of width 0: closed"));
    EXPECT_NO_THROW(read_town(network));
}

TEST_F(NetworkFiles, ThePlaceBesideItGoesAlong) {
    write("a.net.xml", town2());
    EXPECT_EQ(load_network(folder_ / "a.net.xml").place, "");
    write("a.place.xml", "<place/>");
    EXPECT_EQ(load_network(folder_ / "a.net.xml").place, "<place/>");
    write("a.place.xml", "<place>\n<sing/></place>");
    EXPECT_THAT(message(folder_ / "a.net.xml"), HasSubstr("a.place.xml:2: <sing>: is unknown"));
}

TEST_F(NetworkFiles, TooBigAFileIsRefusedBeforeItIsRead) {
    std::filesystem::resize_file(write("big.net.xml", "<net>"), std::uintmax_t{3} << 30);
    EXPECT_THAT(message(folder_ / "big.net.xml"), HasSubstr("has 3072 MB; 512 at most"));
}

TEST_F(NetworkFiles, TheNameIsTheFileNameWithoutEndings) {
    EXPECT_EQ(load_network(write("Town04_sumo115.net.xml", town2())).name, "Town04_sumo115");
    EXPECT_EQ(load_network(write("plain.xml", town2())).name, "plain");
}

TEST_F(NetworkFiles, ClassesOfNewerSumoVersionsAreTakenOutAndSaid) {
    std::string newer = replaced(town2(), "disallow=\"pedestrian", "disallow=\"drone pedestrian");
    newer = replaced(newer, "allow=\"pedestrian\"", "allow=\"pedestrian wheelchair\"");
    const Network network = load_network(write("newer.net.xml", newer));
    EXPECT_THAT(network.notes, HasSubstr("'drone'"));
    EXPECT_THAT(network.notes, HasSubstr("'wheelchair'"));
    EXPECT_THAT(network.xml, Not(HasSubstr("drone")));
    // Nothing else changed: the same lanes, and SUMO runs it.
    const world::TownT town = read_town(network);
    const world::TownT& same = test::own_town("town2").town;
    EXPECT_EQ(town.lanes, same.lanes);
    EXPECT_EQ(town.signals, same.signals);
    const test::Loaded loaded{network, town};
    test::Stage stage(loaded, 5);
    EXPECT_EQ(stage.step().traffic.cars.size(), 5U);
}

/// A street, both of whose directions lie on the same ground, with so many lanes for each.
std::string shared_street(int lanes) {
    std::string net = "<net version=\"1.9\">";
    for (const auto& [id, other, ends, points] :
         {std::tuple("there", "back", "from=\"A\" to=\"B\"", "0,%Y 300,%Y"),
          std::tuple("back", "there", "from=\"B\" to=\"A\"", "300,%Y 0,%Y")}) {
        net += fmt::format("<edge id=\"{}\" {} bidi=\"{}\">", id, ends, other);
        for (int i = 0; i < lanes; ++i)
            net += fmt::format(
                "<lane id=\"{0}_{1}\" index=\"{1}\" speed=\"13.89\" length=\"300\" shape=\"{2}\"/>",
                id,
                i,
                replaced(points, "%Y", fmt::format("{}", 3 * i)));
        net += "</edge>";
    }
    const auto incoming = [lanes](const std::string& edge) {
        return lanes == 1 ? edge + "_0" : edge + "_0 " + edge + "_1";
    };
    return net + fmt::format(
                     "<junction id=\"A\" type=\"dead_end\" x=\"0\" y=\"0\" incLanes=\"{}\" "
                     "intLanes=\"\" shape=\"0,5 0,-3\"/>"
                     "<junction id=\"B\" type=\"dead_end\" x=\"300\" y=\"0\" incLanes=\"{}\" "
                     "intLanes=\"\" shape=\"300,5 300,-3\"/></net>",
                     incoming("back"),
                     incoming("there"));
}

TEST_F(NetworkFiles, LanesThatOncomingTrafficSharesDoNotEndARun) {
    const Network network = load_network(write("shared.net.xml", shared_street(2)));
    EXPECT_THAT(network.notes, HasSubstr("shared.net.xml: 1 road of several lanes that oncoming"));
    EXPECT_THAT(network.xml, Not(HasSubstr("bidi")));
    const test::Loaded loaded{network, read_town(network)};
    test::Stage stage(loaded, 10);
    stage.steps(400);  // SUMO 1.15 aborted in the first one
    EXPECT_EQ(stage.draft().traffic.cars.size(), 10U);
}

TEST_F(NetworkFiles, WhereSumoKnowsOncomingTrafficItIsLeftToKnowIt) {
    const Network network = load_network(write("narrow.net.xml", shared_street(1)));
    EXPECT_EQ(network.notes, "");
    EXPECT_THAT(network.xml, HasSubstr("bidi=\"back\""));
    const test::Loaded loaded{network, read_town(network)};
    test::Stage stage(loaded, 2);
    stage.steps(400);
}

TEST_F(NetworkFiles, ALaneForUnknownClassesOnlyIsALaneForNobody) {
    // An empty allow list would mean: everybody.
    const std::string newer = replaced(town2(), "allow=\"pedestrian\"", "allow=\"drone\"");
    const world::TownT town = read_town(load_network(write("newer.net.xml", newer)));
    const world::LaneT& lane = town.lanes[test::lane(town, "a1_a2_0")];
    EXPECT_EQ(lane.kind, world::LaneKind::other);
}

TEST_F(NetworkFiles, WhatSumoRefusesIsSaidInItsWords) {
    const std::string bad = replaced(town2(), "dir=\"s\"", "dir=\"q\"");
    const test::Loaded loaded = test::load(write("bad.net.xml", bad));
    try {
        test::Stage refused(loaded, 0);
        FAIL() << "SUMO took it";
    } catch (const world::Error& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("bad.net.xml: SUMO refuses it: Unrecognised link direction 'q'"));
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
    // And the process is free for the next one.
    test::Stage stage(test::own_town("town2"), 1);
    EXPECT_EQ(stage.step().traffic.cars.size(), 1U);
}

}  // namespace
}  // namespace reprise::towns

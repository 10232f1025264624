// What is no map, or none that we take, is refused in one line.
#include <cstdint>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/towns/import/imports.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Imports, WhatIsNoMapIsRefusedInOneLine) {
    struct Case {
        const char* name;
        std::string text;
        const char* said;
    };

    std::string cut = bytes(village());
    cut.resize(cut.size() / 2);
    std::string deep = "<OpenDRIVE><road id='1' length='9'>";
    for (int i = 0; i < 2000; ++i)
        deep += "<userData>";
    for (int i = 0; i < 2000; ++i)
        deep += "</userData>";
    deep += "</road></OpenDRIVE>";
    const std::string wide =
        "<net><edge id='e'><lane id='e_0' index='0' speed='9' length='9' width='1000' "
        "shape='0,0 9,0'/></edge></net>";
    const Case cases[] = {
        {"empty.xodr", "", "empty.xodr: is empty"},
        {"binary.osm",
         std::string("\x7f"
                     "ELF\0\0\0",
                     7),
         "binary.osm: is not XML"},
        {"wide.osm", std::string("\xff\xfe<\0", 4), "wide.osm: is written in UTF-16"},
        {"page.osm", "<html></html>", "page.osm: begins with <html>"},
        {"none.xodr", "<OpenDRIVE/>", "none.xodr:1: has no <road>"},
        {"bare.xodr",
         "<OpenDRIVE><road id='1' length='9' junction='-1'/></OpenDRIVE>",
         "bare.xodr: netconvert refuses it: "},
        {"cut.xodr", "<OpenDRIVE>\n<road id='1'", "cut.xodr:2: is not an OpenDRIVE map"},
        {"cut.osm", cut, "cut.osm: is not as OpenStreetMap writes it: XML parsing error at line"},
        {"noroads.osm",
         "<osm version='0.6'><node id='1' lat='1' lon='1'/></osm>",
         "noroads.osm: netconvert refuses it: No nodes loaded: it has no roads"},
        {"path.osm",
         "<osm version='0.6'><node id='1' lat='1' lon='1'/><node id='2' lat='1.001' lon='1'/>"
         "<way id='5'><nd ref='1'/><nd ref='2'/><tag k='highway' v='footway'/></way></osm>",
         "path.osm: what came out of it is no town: has no edge that a passenger car may use"},
        {"far.xodr",
         "<OpenDRIVE>\n<road id='1' length='1e7'/></OpenDRIVE>",
         "far.xodr:2: <road>: length=\"1e7\" is not a number up to 100000"},
        {"nan.xodr",
         "<OpenDRIVE><road id='1' length='9'><planView><geometry s='nan'/></planView></road>"
         "</OpenDRIVE>",
         "<geometry>: s=\"nan\" is not a number"},
        {"deep.xodr", deep, "elements are nested more than 1000 deep"},
        {"wide.net.xml", wide, "<lane>: width=\"1000\" is more than 100 m"},
        {"cut.osm.gz", "\x1f\x8b\x08 and no more", "cut.osm.gz: is damaged or cut off"},
    };
    for (const Case& one : cases) {
        const std::string said = message({write(one.name, one.text), "", false, false});
        EXPECT_THAT(said, HasSubstr(one.said)) << one.name;
        EXPECT_THAT(said, Not(HasSubstr("\n"))) << one.name;
        fs::remove_all(folder_ / "refused");
    }
    EXPECT_THAT(message({folder_, "", false, false}), HasSubstr("is a folder"));
    fs::remove_all(folder_ / "refused");
    EXPECT_THAT(message({folder_ / "none.osm", "", false, false}),
                HasSubstr("none.osm: no such file"));
    fs::remove_all(folder_ / "refused");
    const fs::path own = fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns/town2/town2.net.xml";
    EXPECT_THAT(message({own, "", true, false}), HasSubstr("--lefthand is for OpenStreetMap"));
}

TEST_F(Imports, NetworksThatOnlyANewerSumoLoadsAreRefusedWithSumosReason) {
    struct Case {
        const char* name;
        const char* from;  ///< what 1.15 writes
        const char* to;
        const char* said;
    };

    const Case cases[] = {
        {"major.net.xml", "<net version=\"1.9\"", "<net version=\"2.3\"", "is too new: SUMO's"},
        {"lights.net.xml",
         "type=\"static\"",
         "type=\"quantum\"",
         "lights.net.xml: sumo refuses it: Traffic light "},
        {"turn.net.xml",
         "dir=\"s\"",
         "dir=\"q\"",
         "sumo refuses it: Unrecognised link direction 'q'"},
    };
    const std::string text =
        bytes(fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns/town2/town2.net.xml");
    for (const Case& one : cases) {
        std::string newer = text;
        const std::size_t at = newer.find(one.from);
        ASSERT_NE(at, std::string::npos) << one.name;
        newer.replace(at, std::string(one.from).size(), one.to);
        const std::string said = message({write(one.name, newer), "", false, false});
        EXPECT_THAT(said, HasSubstr(one.said)) << one.name;
        EXPECT_THAT(said, Not(HasSubstr("\n"))) << one.name;
        fs::remove_all(folder_ / "refused");
    }
}

TEST_F(Imports, HugeGarbageIsRefusedBeforeItIsRead) {
    for (const char* beginning : {"", "<osm version='0.6'>\n", "<OpenDRIVE>"}) {
        const fs::path path = write("big.osm", beginning);
        fs::resize_file(path, std::uintmax_t{3} << 30);  // sparse
        EXPECT_THAT(message({path, "", false, false}),
                    testing::AnyOf(HasSubstr("is not XML"), HasSubstr("has 3072 MB")));
        fs::remove_all(folder_ / "refused");
    }
}

}  // namespace
}  // namespace reprise::towns

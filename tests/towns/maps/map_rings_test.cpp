#include "towns/maps/map_rings.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <pugixml.hpp>

#include "tests/towns/street_map.h"
#include "world/check.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;

class Rings : public testing::Test {
  protected:
    Rings() { fs::create_directories(folder_); }

    ~Rings() override { fs::remove_all(folder_); }

    MapRings read(const std::string& map) const {
        std::ofstream(folder_ / "map.osm", std::ios::binary) << map;
        return read_rings(folder_ / "map.osm", "harbour.osm");
    }

    std::string refusal(const std::string& map) const {
        try {
            read(map);
        } catch (const world::Error& error) {
            return error.what();
        }
        return "no error";
    }

    fs::path folder_ =
        fs::path(testing::TempDir()) / ("reprise rings, " + std::to_string(getpid()));
};

using Ring = std::pair<std::string, std::vector<int>>;

/// The tag "name" and the nodes of each.
std::vector<Ring> rings_of(const MapRings& found) {
    pugi::xml_document document;
    document.load_string(found.osm.c_str());
    std::vector<Ring> rings;
    for (const pugi::xml_node way : document.document_element().children("way")) {
        const pugi::xml_node name = way.find_child_by_attribute("tag", "k", "name");
        rings.emplace_back(name.attribute("v").value(), std::vector<int>());
        for (const pugi::xml_node node : way.children("nd"))
            rings.back().second.push_back(node.attribute("ref").as_int());
    }
    return rings;
}

const Tagged park{{"leisure", "park"}, {"name", "Park"}};

TEST_F(Rings, OuterAndInnerOnesOfSeveralWays) {
    StreetMap map;
    for (int i = 0; i < 8; ++i)
        map.node(i, i * i);
    const int south = map.way({1, 2, 3}, {}), north = map.way({1, 4, 3}, {});
    const int left = map.way({5, 6}, {}), right = map.way({6, 7, 8, 5}, {});
    map.multipolygon({{south, "outer"}, {left, "inner"}, {north, ""}, {right, "inner"}}, park);
    const MapRings found = read(map.text());
    EXPECT_EQ(found.open, 0);
    EXPECT_THAT(rings_of(found),
                ElementsAre(Pair("Park", ElementsAre(1, 2, 3, 4, 1)),
                            Pair("Park", ElementsAre(5, 6, 7, 8, 5))));
    EXPECT_THAT(found.osm, HasSubstr("<tag k=\"leisure\" v=\"park\"/>"));
    EXPECT_THAT(found.osm, HasSubstr("<tag k=\"type\" v=\"multipolygon\"/>"));
}

TEST_F(Rings, AnOuterAndAnInnerWayThatMeetAreNotJoined) {
    StreetMap map;
    const int outer = map.way({1, 2, 3}, {}), inner = map.way({3, 4, 1}, {});
    map.multipolygon({{outer, "outer"}, {inner, "inner"}}, park);
    const MapRings found = read(map.text());
    EXPECT_EQ(found.open, 1);
    EXPECT_THAT(found.osm, IsEmpty());
}

TEST_F(Rings, WaysThatAnExtractLacksLeaveTheirRingOpenAndTheOthersWhole) {
    StreetMap map;
    const int south = map.way({1, 2, 3}, {}), north = map.way({3, 4, 1}, {});
    const int cut = map.way({5, 6, 7}, {});
    map.multipolygon({{cut, "outer"}, {777, "outer"}, {south, "outer"}, {north, "outer"}}, park);
    map.multipolygon({{778, "outer"}, {779, "outer"}}, park);
    const MapRings found = read(map.text());
    EXPECT_EQ(found.open, 2);
    EXPECT_THAT(rings_of(found), ElementsAre(Pair("Park", ElementsAre(1, 2, 3, 4, 1))));
}

TEST_F(Rings, WaysListedTwiceCountOnce) {
    StreetMap map;
    const int south = map.way({1, 2, 3}, {}), north = map.way({3, 4, 1}, {});
    map.multipolygon({{south, "outer"}, {south, "outer"}, {north, "outer"}, {north, ""}}, park);
    std::string text = map.text();
    // As where two extracts were put together: the whole way and the whole relation again.
    for (const std::string_view element : {"way", "relation"}) {
        const std::size_t from = text.find("<" + std::string(element));
        const std::string ending = "</" + std::string(element) + ">";
        const std::size_t to = text.find(ending, from) + ending.size();
        text.insert(to, text.substr(from, to - from));
    }
    const MapRings found = read(text);
    EXPECT_EQ(found.open, 0);
    EXPECT_THAT(rings_of(found), ElementsAre(Pair("Park", ElementsAre(1, 2, 3, 4, 1))));
}

TEST_F(Rings, WaysThatAreRingsAlreadyAndAreasThatNoTownShowsAreLeftOut) {
    StreetMap map;
    const int ring = map.way({1, 2, 3, 1}, {});
    const int south = map.way({1, 2, 3}, {}), north = map.way({3, 4, 1}, {});
    map.multipolygon({{ring, "outer"}}, park);
    map.multipolygon({{south, "outer"}, {north, "outer"}}, {{"boundary", "administrative"}});
    const MapRings found = read(map.text());
    EXPECT_EQ(found.open, 0);
    EXPECT_THAT(found.osm, IsEmpty());
}

TEST_F(Rings, DoNotDependOnTheOrderOfTheFile) {
    const std::string ways =
        "<way id='1'><nd ref='1'/><nd ref='2'/></way><way id='2'><nd ref='2'/><nd ref='3'/>"
        "<nd ref='1'/></way>";
    const auto relation = [](const char* id, const char* name) {
        return fmt::format(
            "<relation id='{}'><member type='way' ref='1' role=''/><member type='way' ref='2' "
            "role=''/><tag k='type' v='multipolygon'/><tag k='leisure' v='park'/>"
            "<tag k='name' v='{}'/></relation>",
            id,
            name);
    };
    const std::string first = relation("7", "First"), second = relation("8", "Second");
    const MapRings sorted = read("<osm version='0.6'>" + ways + first + second + "</osm>");
    EXPECT_THAT(rings_of(sorted),
                ElementsAre(Pair("First", ElementsAre(1, 2, 3, 1)),
                            Pair("Second", ElementsAre(1, 2, 3, 1))));
    EXPECT_EQ(read("<osm version='0.6'>" + second + first + ways + "</osm>").osm, sorted.osm);
}

TEST_F(Rings, AreReadBeyondOneBlockOfTheReader) {
    // 20 MB of ways before those that are wanted, and as many rings as make several buffers.
    std::string text = "<osm version='0.6'>";
    for (int i = 0; i < 60'000; ++i)
        text += fmt::format("<way id='{}'>", 1'000'000 + i) +
                "<nd ref='1'/><nd ref='2'/><tag k='highway' v='footway'/>" + std::string(250, ' ') +
                "</way>";
    const int rings = 3000;
    for (int i = 1; i <= rings; ++i)
        text += fmt::format(
            "<way id='{0}'><nd ref='{0}'/><nd ref='{1}'/></way><way id='{1}'><nd ref='{1}'/>"
            "<nd ref='{2}'/><nd ref='{0}'/></way>",
            10 * i,
            10 * i + 1,
            10 * i + 2);
    for (int i = 1; i <= rings; ++i)
        text += fmt::format(
            "<relation id='{}'><member type='way' ref='{}' role=''/><member type='way' ref='{}' "
            "role=''/><tag k='type' v='multipolygon'/><tag k='building' v='yes'/></relation>",
            i,
            10 * i,
            10 * i + 1);
    const std::vector<Ring> found = rings_of(read(text + "</osm>"));
    ASSERT_EQ(found.size(), static_cast<std::size_t>(rings));
    for (int i = 1; i <= rings; ++i)
        EXPECT_THAT(found[static_cast<std::size_t>(i - 1)].second,
                    ElementsAre(10 * i, 10 * i + 1, 10 * i + 2, 10 * i));
}

TEST_F(Rings, WhatLibosmiumRefusesIsSaidInOneLine) {
    const std::string relation =
        "<relation id='1'><member type='way' ref='1' role=''/><tag k='type' "
        "v='multipolygon'/><tag k='building' v='yes'/></relation>";

    struct Case {
        std::string map, said;
    };

    std::string bomb = "<!DOCTYPE osm [<!ENTITY a 'aaaaaaaaaa'>";
    for (char c = 'b'; c <= 'z'; ++c)
        bomb +=
            fmt::format("<!ENTITY {0} '&{1};&{1};&{1};&{1};&{1};&{1};&{1};&{1};'>", c, char(c - 1));
    const Case cases[] = {
        {"", "no element found"},
        {"<osm version='0.6'>" + relation, "no element found"},
        {"<osm version='0.6'>" + relation + "</osm", "line 1, column"},
        {"<osm version='0.6'><way></osm>", "mismatched tag"},
        {"<html/>", "Unknown top-level element: html"},
        {"<osm>" + relation + "</osm>", "missing version"},
        {"<osm version='7&#10;8'/>", R"(version 7\x0a8)"},
        {bomb + "]><osm version='0.6'>&z;</osm>", "entities are not supported"},
        {"<osm version='0.6'><relation id='many'/></osm>", "illegal id: 'many'"},
        {"<osm version='0.6'><relation id='1'><member type='way'/></relation></osm>",
         "Missing ref on relation <member>"},
        {"<osm version='0.6'><relation id='1'><tag k='name' v='" + std::string(5000, 'x') +
             "'/></relation></osm>",
         "OSM tag value is too long"},
        {"<?xml version='1.0' encoding='windows-1252'?><osm version='0.6'/>", "unknown encoding"},
    };
    for (const Case& one : cases) {
        const std::string said = refusal(one.map);
        EXPECT_THAT(said, testing::StartsWith("harbour.osm: is not as OpenStreetMap writes it: "));
        EXPECT_THAT(said, HasSubstr(one.said));
        EXPECT_THAT(said, Not(HasSubstr("\n")));
    }
    EXPECT_THROW(read_rings(folder_ / "none.osm", "none.osm"), world::Error);
}

/// Threads of this process.
std::ptrdiff_t threads() {
    return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
}

TEST_F(Rings, LeaveNoThreadBehindWhenReadOrRefused) {
    const std::ptrdiff_t before = threads();
    read("<osm version='0.6'/>");
    refusal("<osm version='0.6'><way>" + std::string(30 << 20, ' ') + "</osm>");
    // One that breaks off early, with much of the file unread.
    refusal("<osm version='0.6'><oh></no>" + std::string(30 << 20, ' '));
    EXPECT_EQ(threads(), before);
}

}  // namespace
}  // namespace reprise::towns

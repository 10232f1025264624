#include "towns/maps/openstreetmap_check.h"

#include <fstream>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "world/check.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;

class OpenStreetMapCheck : public testing::Test {
  protected:
    OpenStreetMapCheck() : file_(fs::path(testing::TempDir()) / fmt::format("{}.osm", getpid())) {}

    ~OpenStreetMapCheck() override { fs::remove(file_); }

    static std::string village() {
        std::ifstream file(REPRISE_SOURCE_DIR "/tests/towns/village.osm");
        return {std::istreambuf_iterator<char>(file), {}};
    }

    std::string refusal(const std::string& from, const std::string& to) const {
        std::string xml = village();
        EXPECT_NE(xml.find(from), std::string::npos) << from;
        xml.replace(xml.find(from), from.size(), to);
        std::ofstream(file_, std::ios::binary) << xml;
        try {
            check_openstreetmap(file_, "village.osm");
        } catch (const world::Error& error) {
            return error.what();
        }
        return "";
    }

    fs::path file_;
};

TEST_F(OpenStreetMapCheck, TakesTheVillage) {
    EXPECT_EQ(refusal("generator=\"by hand\"", "generator=\"by hand\""), "");
}

TEST_F(OpenStreetMapCheck, NamesTheNodeThatIsOutOfPlace) {
    const std::string north_road = R"(<node id="103" lat="51.4536187" lon="-2.5900000"/>)";
    for (const char* longitude : {"-2.1", "2.59", "10", "-179", "179.9"}) {
        const std::string told = refusal(
            north_road, fmt::format(R"(<node id="103" lat="51.4536187" lon="{}"/>)", longitude));
        EXPECT_THAT(told, HasSubstr("village.osm: way "));
        EXPECT_THAT(told, HasSubstr("is node 103 in its place?"));
    }
    // A corner of a building as well.
    EXPECT_THAT(refusal(R"(id="114" lat="51.4522698")", R"(id="114" lat="11.4522698")"),
                HasSubstr("is node 114 in its place?"));
}

TEST_F(OpenStreetMapCheck, NamesTheNodeThatIsNotOnTheGlobe) {
    for (const char* latitude : {"91", "-1000"})
        EXPECT_THAT(refusal(R"(<node id="103" lat="51.4536187")",
                            fmt::format(R"(<node id="103" lat="{}")", latitude)),
                    HasSubstr("village.osm: "));
}

TEST_F(OpenStreetMapCheck, NamesCoordinatesThatTwoReadersWouldNotReadAlike) {
    for (const char* longitude : {"1e30", "-1E90000", "1&#101;40", "0x2", "1,5", "nan"})
        EXPECT_THAT(
            refusal(R"(<node id="103" lat="51.4536187" lon="-2.5900000"/>)",
                    fmt::format(R"(<node id="103" lat="51.4536187" lon="{}"/>)", longitude)),
            ContainsRegex("village.osm:[0-9]+: node 103: lon=\"[^\"]+\": digits with"))
            << longitude;
    EXPECT_THAT(refusal("<osm version=\"0.6\"", "<osm version=\"0.6\" minlat=\"1e30\""),
                HasSubstr("osm: minlat="));
}

TEST_F(OpenStreetMapCheck, NamesTheWayWithImpossibleTags) {
    const std::string way = R"(<tag k="lanes" v="2"/>)";
    EXPECT_THAT(refusal(way, R"(<tag k="lanes" v="100000"/>)"),
                HasSubstr("village.osm: way 2: lanes=100000: 64 at most are possible"));
    EXPECT_THAT(refusal(way, R"(<tag k="lanes:forward" v="2;9999"/>)"), HasSubstr("way 2"));
    EXPECT_THAT(refusal(way, R"(<tag k="layer" v="-99999"/>)"), HasSubstr("way 2"));
    EXPECT_THAT(refusal(way, R"(<tag k="width" v="1e9"/>)"), HasSubstr("way 2: width=1e9"));
    EXPECT_THAT(refusal(way, R"(<tag k="width" v="3 m;.1e+7;2"/>)"), HasSubstr("way 2"));
    EXPECT_THAT(refusal(way, R"(<tag k="width" v="1e999"/>)"), HasSubstr("way 2"));
    EXPECT_THAT(refusal(way, R"(<tag k="width" v="100000 m"/>)"), HasSubstr("way 2"));
    EXPECT_EQ(refusal(way, R"(<tag k="lanes" v="3"/><tag k="layer" v="-1"/>)"), "");
}

TEST_F(OpenStreetMapCheck, BoundsMembersAndNames) {
    std::string members;
    for (int i = 0; i < 40'000; ++i)
        members += "<member type=\"way\" ref=\"1\" role=\"outer\"/>";
    EXPECT_THAT(refusal("</osm>", "<relation id=\"9\">" + members + "</relation></osm>"),
                HasSubstr("relation 9"));
    EXPECT_NE(refusal("Mill Lane", std::string(1 << 20, 'x')), "");
}

}  // namespace
}  // namespace reprise::towns

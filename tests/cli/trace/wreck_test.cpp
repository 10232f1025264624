// A car of traffic that is hit: how a run, the page's story and the tables tell of it.
#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

class WreckedCar : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        folder = std::make_unique<Folder>();
        write_file(folder->path() / "a.lua",
                   "return scenario 'a' { town = 'straight', duration = 4, run = function()\n"
                   "local van = spawn{ name = 'van', model = 'van', driver = 'traffic',\n"
                   "                   lane = 'east_1', s = 160, speed = 5 }\n"
                   "van:hold_speed(5)\n"
                   "local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual',\n"
                   "                   lane = 'east_1', s = 140, speed = 15 }\n"
                   "ego:control{}\nwait(60) end }");
        said = reprise({"run", "a.lua", "-o", "a.mcap"}, folder->path()).out;
    }

    static void TearDownTestSuite() { folder.reset(); }

    static inline std::unique_ptr<Folder> folder;
    static inline std::string said;
};

TEST_F(WreckedCar, IsToldWhileTheRunGoesOn) {
    EXPECT_THAT(said, HasSubstr(" s  van is hit at 5.0 m/s, and a wreck from here on\n"));
    EXPECT_THAT(reprise({"info", "a.mcap"}, folder->path()).out,
                HasSubstr("van is hit at 5.0 m/s, and a wreck from here on"));
}

/// It is pushed over the limit, and past a line perhaps; nobody drives it.
TEST_F(WreckedCar, DoesNothingWrong) {
    const std::string scores = reprise({"score", "a.mcap"}, folder->path()).out;
    EXPECT_THAT(scores, HasSubstr("ego ("));
    EXPECT_THAT(scores, testing::Not(HasSubstr("\nvan (")));
    EXPECT_NE(reprise({"score", "a.mcap", "--actor", "van"}, folder->path()).code, 0);
}

/// It has rows in `vehicles`, so a vehicle is what it is; until then it was a car.
TEST_F(WreckedCar, IsOneActorThatIsAVehicleSinceThen) {
    const std::string actors =
        reprise({"cat", "a.mcap", "--format", "csv", "--fields", "actors"}, folder->path()).out;
    EXPECT_THAT(actors, HasSubstr("despawned [s],wrecked [s]\n"));
    const std::size_t at = actors.find(",van,");
    ASSERT_NE(at, std::string::npos) << actors;
    EXPECT_EQ(actors.find(",van,", actors.find('\n', at)), std::string::npos) << "one row";
    const std::string row = actors.substr(at, actors.find('\n', at) - at);
    EXPECT_THAT(row, HasSubstr(",van,vehicle,van,"));
    const double wrecked = std::stod(row.substr(row.rfind(',') + 1));
    EXPECT_THAT(reprise({"query", "a.mcap", "select min(tick) * 0.05 t from vehicles where id = 1"},
                        folder->path())
                    .out,
                HasSubstr(row.substr(row.rfind(',') + 1)))
        << "its first row of a body is at " << wrecked;
    EXPECT_THAT(row, HasSubstr(",0.05,,")) << "when it came; it never left";
}

}  // namespace
}  // namespace reprise::test

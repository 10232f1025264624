#include <gmock/gmock.h>

#include "tests/cli/program.h"
#include "tests/replay/forgery.h"

namespace reprise::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A run of a second with a check that fails, and copies of its trace in which somebody changed
/// something and made every checksum right again.
class Forged : public testing::Test {
  protected:
    void SetUp() override {
        write_file(folder_ / "slow.lua", R"(
            return scenario 'slow' { town = 'town1', cars = 1, seed = 7, run = function()
                local ego = spawn{ name = 'ego', model = 'sedan' }
                check.max('slow', function() return ego:speed() end, -1)
                wait(1)
            end })");
        ASSERT_EQ(run({"run", "slow.lua", "-o", "a.mcap"}).code, 1);
        whole_ = read_file(folder_ / "a.mcap");
    }

    Result run(const std::vector<std::string>& words) const {
        return reprise(words, folder_.path());
    }

    /// Replaces a text by one of its length, everywhere or, in the script's attachment, there only.
    void forge(const std::string& from, const std::string& to, bool first_only = false) {
        ASSERT_EQ(from.size(), to.size());
        std::string text = whole_;
        std::size_t changes = 0;
        for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
            text.replace(at, from.size(), to);
            ++changes;
            if (first_only)
                break;
        }
        ASSERT_GT(changes, 0U) << from;
        std::vector<std::uint8_t> bytes(text.begin(), text.end());
        repair_checksums(bytes);
        write_file(folder_ / "forged.mcap", std::string(bytes.begin(), bytes.end()));
    }

    /// All three commands say it, each in its way.
    void expect_told(const std::string& by_verify, int code) const {
        const Result verify = run({"verify", "forged.mcap"});
        EXPECT_EQ(verify.code, code) << verify.out;
        EXPECT_THAT(verify.out, AllOf(HasSubstr(by_verify), Not(HasSubstr("equal at every"))));
        const Result diff = run({"diff", "a.mcap", "forged.mcap"});
        EXPECT_THAT(diff.code, testing::AnyOf(1, 2)) << diff.out;
    }

    const Folder folder_;
    std::string whole_;
};

/// A metadata text as MCAP has it: length, then bytes.
std::string mcap_text(const std::string& text) {
    return std::string{static_cast<char>(text.size()), 0, 0, 0} + text;
}

TEST_F(Forged, OutcomeIsTold) {
    forge(mcap_text("failed"), mcap_text("passed"));
    expect_told("expected  passed: scenario ended", 1);
    const Result info = run({"info", "forged.mcap"});
    EXPECT_EQ(info.code, 2);
    EXPECT_THAT(info.out,
                HasSubstr("its outcome says 'passed: scenario ended', its ticks 'failed: scenario "
                          "ended': it was changed after it was recorded"));
}

TEST_F(Forged, ScriptIsTold) {
    const std::size_t attached = whole_.find("scenario/main.lua");
    const std::size_t at = whole_.find("cars = 1", attached);
    std::string text = whole_;
    text.replace(at, 8, "cars = 9");
    std::vector<std::uint8_t> bytes(text.begin(), text.end());
    repair_checksums(bytes);
    write_file(folder_ / "forged.mcap", std::string(bytes.begin(), bytes.end()));
    expect_told("in the attachment 'scenario/main.lua'", 1);
    forge("cars = 1", "cars = 9");  // and in the episode
    expect_told("the metadata 'reprise.outcome' was changed after it was recorded: episode is", 2);
}

TEST_F(Forged, SeedIsTold) {
    forge(mcap_text("seed") + mcap_text("7"), mcap_text("seed") + mcap_text("9"));
    expect_told(
        "the metadata 'reprise.run' was changed after it was recorded: seed is '9', where "
        "'7' was written",
        2);
    EXPECT_EQ(run({"info", "forged.mcap"}).code, 2);
}

TEST_F(Forged, HonestTraceIsEqual) {
    EXPECT_EQ(run({"verify", "a.mcap"}).code, 0);
    EXPECT_EQ(run({"diff", "a.mcap", "a.mcap"}).code, 0);
    EXPECT_THAT(run({"info", "a.mcap"}).out,
                AllOf(HasSubstr("outcome   failed: scenario ended"),
                      HasSubstr("checked   that it agrees with itself; `reprise verify`")));
}

TEST_F(Forged, TraceWithAWholeChainOfItsOwnIsToldByTheChainWrittenDown) {
    const std::string info = run({"info", "a.mcap"}).out;
    const std::size_t at = info.find("  chain     ") + 12;
    std::string chain = info.substr(at, 32);
    const Result good = run({"verify", "a.mcap", "--expect", chain});
    EXPECT_EQ(good.code, 0) << good.out;
    std::transform(chain.begin(), chain.end(), chain.begin(), ::toupper);
    EXPECT_EQ(run({"verify", "a.mcap", "--expect", chain}).code, 0);
    // Who runs it anew with another seed has a trace that is right in itself.
    run({"run", "slow.lua", "--seed", "8", "-o", "b.mcap"});
    EXPECT_EQ(run({"verify", "b.mcap"}).code, 0);
    const Result other = run({"verify", "b.mcap", "--expect", info.substr(at, 32)});
    EXPECT_EQ(other.code, 1);
    EXPECT_THAT(other.out,
                AllOf(testing::StartsWith("b.mcap: differs: its chain is "),
                      HasSubstr(", not " + info.substr(at, 32) +
                                ": another run, or one that was "
                                "changed\n")));
    EXPECT_EQ(std::count(other.out.begin(), other.out.end(), '\n'), 1);
    const Result wrong = run({"verify", "a.mcap", "--expect", "abc"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_THAT(wrong.out, HasSubstr("expected a chain of 32 hexadecimal digits, got 'abc'"));
}

TEST_F(Forged, PartSaysWhatItCannotShow) {
    ASSERT_EQ(run({"slice", "a.mcap", "--ticks", "..10", "-o", "s.mcap"}).code, 0);
    const Result part = run({"verify", "s.mcap"});
    EXPECT_EQ(part.code, 0) << part.out;
    EXPECT_THAT(part.out, HasSubstr("  unseen    how the run went on behind tick 10 to tick "));
    EXPECT_THAT(run({"info", "s.mcap"}).out, HasSubstr("outcome   part: "));
}

}  // namespace
}  // namespace reprise::test

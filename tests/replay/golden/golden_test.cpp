#include "replay/golden/golden.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "replay/golden/golden_difference.h"
#include "replay/trace_reader.h"
#include "tests/replay/synthetic_run.h"
#include "tests/support/worlds.h"
#include "world/digest.h"

namespace reprise::replay {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Raises an event in one tick.
test::Change say(std::uint64_t tick,
                 world::EventKind kind,
                 const std::string& text,
                 const std::string& detail = "") {
    return [=](world::TickDraft& draft) {
        if (draft.tick.index != tick)
            return;
        world::EventT event;
        event.kind = kind;
        event.text = text;
        event.detail = detail;
        event.line = 12;
        draft.tick.events.push_back(event);
    };
}

class GoldenOf : public testing::Test {
  protected:
    TraceReader trace(const test::SyntheticRun& run) {
        const auto path = folder_ / fmt::format("{}.mcap", count_++);
        test::write_trace(path, run);
        return TraceReader(path);
    }

    Golden golden(const test::SyntheticRun& run, std::optional<Sampling> sampling = {}) {
        TraceReader reader = trace(run);
        return make_golden(reader, sampling);
    }

    /// How a run with this change differs from the one without.
    std::optional<GoldenDifference> difference(const test::Change& change) {
        return compare(golden({}), golden({.change = change}));
    }

    test::Folder folder_;
    int count_ = 0;
};

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

/// These lines with the seal that belongs to them: what an edit that knows the format would make.
std::string sealed(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        if (line != "}" && !line.starts_with("\"seal\""))
            text += line + "\n";
    if (text.ends_with(",\n"))
        text.resize(text.size() - 2);  // they belong to the seal
    world::Hasher hasher;
    hasher.add_text(text);
    return text + fmt::format(",\n\"seal\": \"{:016x}\"\n}}\n", hasher.digest64());
}

bool is_refused(const std::string& text) {
    return !test::error_of([&] { parse_golden(text, "x.golden"); }).empty();
}

char other(char c) {
    return c == '9' || c == 'z' || c == 'Z' ? static_cast<char>(c - 1) : static_cast<char>(c + 1);
}

TEST_F(GoldenOf, TextReadsBackTheSame) {
    Golden one = golden({.change = say(33, world::EventKind::printed, "a \"b\"\\\n\x01 ü")});
    one.because = "a new \"reason\"\nin two lines";
    one.given = {"../nets/my town.net.xml", "3", "12.5", {{"gap", "20"}, {"word", "a b"}}};
    const std::string text = to_text(one);
    const Golden read = parse_golden(text, "x.golden");
    EXPECT_EQ(to_text(read), text);
    EXPECT_EQ(read.because, one.because);
    EXPECT_EQ(read.given, one.given);
    EXPECT_EQ(read.events, one.events);
    EXPECT_EQ(read.states, one.states);
    EXPECT_EQ(compare(read, one), std::nullopt);
}

TEST_F(GoldenOf, EqualRunsAreEqual) {
    EXPECT_EQ(to_text(golden({})), to_text(golden({})));
}

TEST_F(GoldenOf, AnyCharacterOfTheFileThatChangesIsRefused) {
    const std::string text = to_text(golden({.ticks = 45}));
    for (std::size_t i = 0; i < text.size(); ++i) {
        std::string mutated = text;
        mutated[i] = other(text[i]);
        EXPECT_TRUE(is_refused(mutated)) << "byte " << i << ", '" << text[i] << "'";
    }
    for (std::size_t size = 0; size < text.size(); size += 7)
        EXPECT_TRUE(is_refused(text.substr(0, size))) << size;
}

/// Where the seal is forged too, the comparison itself must see it.
TEST_F(GoldenOf, EveryLineOfTheRunThatChangesIsNoticed) {
    TraceReader run =
        trace({.ticks = 70, .change = say(33, world::EventKind::check_passed, "gap")});
    const Golden whole = make_golden(run);
    const std::vector<std::string> lines = lines_of(to_text(whole));
    const auto noticed = [&](const std::vector<std::string>& mutated) {
        const std::string text = sealed(mutated);
        if (is_refused(text))
            return true;
        const Golden golden = parse_golden(text, "x.golden");
        return compare(golden, make_golden(run, golden.sampling)).has_value();
    };
    ASSERT_FALSE(noticed(lines));
    const auto first = std::find_if(lines.begin(), lines.end(), [](const std::string& line) {
        return line.starts_with("\"step_ns\"");
    });
    std::size_t tried = 0;
    for (auto i = static_cast<std::size_t>(first - lines.begin()); i < lines.size(); ++i) {
        if (lines[i] == "}" || lines[i].starts_with("\"seal\""))
            continue;
        std::vector<std::string> mutated = lines;
        mutated.erase(mutated.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_TRUE(noticed(mutated)) << "without: " << lines[i];
        mutated = lines;
        mutated.insert(mutated.begin() + static_cast<std::ptrdiff_t>(i), lines[i]);
        EXPECT_TRUE(noticed(mutated)) << "twice: " << lines[i];
        const std::size_t number = lines[i].find("\"line\":");  // of the scenario: it may move
        for (std::size_t at = 0; at < lines[i].size(); ++at) {
            if (number != std::string::npos && at > number + 6 &&
                lines[i].find_first_not_of("0123456789", number + 7) > at)
                continue;
            mutated = lines;
            mutated[i][at] = other(mutated[i][at]);
            EXPECT_TRUE(noticed(mutated)) << "byte " << at << " of: " << lines[i];
            ++tried;
        }
    }
    EXPECT_GT(tried, 500U);
}

TEST_F(GoldenOf, MistakesNameFileAndLine) {
    const std::string text = to_text(golden({.ticks = 45}));
    const auto error = [](const std::string& broken) {
        return test::error_of([&] { parse_golden(broken, "cut_in.golden"); });
    };
    EXPECT_THAT(error(""), HasSubstr("cut_in.golden:1: not a golden"));
    EXPECT_THAT(error("return scenario 'cut_in' {\n"), HasSubstr("cut_in.golden:1: not a golden"));
    std::string merged = text;
    merged.insert(merged.find("\"chain\""), "<<<<<<< HEAD\n");
    const auto line = std::count(text.begin(), text.begin() + text.find("\"chain\""), '\n') + 1;
    EXPECT_THAT(error(merged),
                HasSubstr(fmt::format("cut_in.golden:{}: no JSON: cut off, or merged; restore the "
                                      "file, or remove it and accept the case again: <<<<<<< HEAD",
                                      line)));
    EXPECT_THAT(error(text.substr(0, text.size() / 2)), HasSubstr("cut off"));
    EXPECT_THAT(error(text.substr(0, text.rfind(",\n\"seal")) + "\n}\n"),
                HasSubstr("cut off: a golden ends in its seal"));
    std::string edited = text;
    const auto verdict = edited.find("\"verdict\": \"passed\"");
    ASSERT_NE(verdict, std::string::npos);
    edited.replace(verdict, 19, "\"verdict\": \"failed\"");
    EXPECT_THAT(error(edited), HasSubstr("the seal does not hold"));
    EXPECT_THAT(test::error_of([&] { load_golden(folder_ / "none.golden"); }),
                HasSubstr("none.golden: cannot be read"));
}

/// Nobody reads what an older program, or a newer one, wrote: the same case is accepted again.
TEST_F(GoldenOf, AnotherFormatIsRefusedWithTheWayToANewOne) {
    const auto error = [](const std::string& text) {
        return test::error_of([&] { parse_golden(text, "cut_in.golden"); });
    };
    EXPECT_THAT(error("reprise golden 1\n# `reprise test` compares\nbecause \"x\"\n"),
                HasSubstr("cut_in.golden:1: a golden of format 1; this program reads format 3; "
                          "remove the file and accept the case again (reprise accept SCENARIO "
                          "--because ...)"));
    EXPECT_THAT(error("{\n\"reprise_golden\": 4,\n[what only format 4 knows]\n"),
                HasSubstr("cut_in.golden:2: a golden of format 4; this program reads format 3"));
}

/// Digits that a reader of JSON may round are texts: all of them stay.
TEST_F(GoldenOf, NumbersKeepEveryBit) {
    const double odd[] = {0.1 + 0.2, -0.0, 5e-324, 1.7976931348623157e308, std::nan("")};
    std::size_t i = 0;
    const Golden one = golden({.ticks = 45, .change = [&](world::TickDraft& draft) {
                                   if (draft.tick.index != 40)
                                       return;
                                   world::VehicleState& car = draft.tick.vehicles.front();
                                   car.mutable_position() = {odd[0], odd[1], odd[2]};
                                   car.mutable_velocity() = {odd[3], odd[4], 0};
                               }});
    const Golden read = parse_golden(to_text(one), "x.golden");
    EXPECT_EQ(read.states, one.states);
    for (const auto& [name, text] : read.states.at(1).values) {
        if (i == std::size(odd))
            break;
        double back = 0;
        std::from_chars(text.data(), text.data() + text.size(), back);
        EXPECT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(odd[i++]))
            << name << " " << text;
    }
}

TEST_F(GoldenOf, TextThatIsNotUtf8KeepsADigestOfItsBytes) {
    const auto with = [&](const char* text) {
        return golden({.ticks = 45, .change = say(33, world::EventKind::printed, text)});
    };
    const Golden one = with("a \xff");
    EXPECT_EQ(compare(parse_golden(to_text(one), "x.golden"), one), std::nullopt);
    EXPECT_NE(compare(one, with("a \xfe")), std::nullopt);
    const Golden half = with((std::string(199, 'x') + "ü and more").c_str());  // cut at 200 bytes
    EXPECT_EQ(compare(parse_golden(to_text(half), "x.golden"), half), std::nullopt);
    Golden reason = one;
    reason.because = "because \xff";
    EXPECT_THAT(test::error_of([&] { to_text(reason); }), HasSubstr("UTF-8"));
}

TEST_F(GoldenOf, MinuteAmongAHundredCarsIsUnder25KB) {
    const Golden minute = golden({.ticks = 1200, .cars = 100});
    EXPECT_LT(to_text(minute).size(), 25'000U);
    EXPECT_THAT(minute.checkpoints, SizeIs(60));
    EXPECT_THAT(minute.states, SizeIs(60));
    EXPECT_EQ(minute.background.back().cars, 100U);
}

TEST_F(GoldenOf, MinuteThatPrintsInEveryTickIsUnder40KB) {
    const Golden minute =
        golden({.ticks = 1200, .change = [](world::TickDraft& draft) {
                    say(draft.tick.index, world::EventKind::printed, "again")(draft);
                }});
    EXPECT_LT(to_text(minute).size(), 40'000U);
    const Golden other = golden(
        {.ticks = 1200, .change = [](world::TickDraft& draft) {
             const bool late = draft.tick.index == 1000;
             say(draft.tick.index, world::EventKind::printed, late ? "agaim" : "again")(draft);
         }});
    EXPECT_EQ(compare(minute, other)->events.different, 1U);
}

TEST_F(GoldenOf, LongRunsSaySomethingLessOften) {
    const Golden hour = golden({.ticks = 14'400, .cars = 0});  // 12 minutes
    EXPECT_EQ(hour.sampling, (Sampling{2, 8}));
    EXPECT_THAT(hour.checkpoints, SizeIs(360));
    EXPECT_THAT(hour.states, SizeIs(90));
}

TEST_F(GoldenOf, LastTickOfARunIsThereAlways) {
    const Golden run = golden({.ticks = 47});
    std::vector<std::uint64_t> ticks;
    for (const Checkpoint& checkpoint : run.checkpoints)
        ticks.push_back(checkpoint.tick);
    EXPECT_THAT(ticks, ElementsAre(20, 40, 47));
    EXPECT_THAT(golden({.ticks = 0}).checkpoints, IsEmpty());
}

TEST_F(GoldenOf, ChangeInOneTickShowsInItsSecondAndStage) {
    const auto found = difference([](world::TickDraft& draft) {
        if (draft.tick.index == 45)
            draft.tick.digests.mutate_physics(draft.tick.digests.physics() + 1);
    });
    ASSERT_TRUE(found);
    EXPECT_EQ(found->severity, Severity::numbers);
    EXPECT_EQ(found->equal_until, 40U);
    EXPECT_EQ(found->checkpoints.first->tick, 60U);
    EXPECT_EQ(found->checkpoints.first->what, "physics");
    EXPECT_EQ(found->states.different, 0U);
}

TEST_F(GoldenOf, LastBitOfARecordedValueIsShown) {
    const auto found = difference([](world::TickDraft& draft) {
        if (draft.tick.index != 60)
            return;
        world::VehicleState& car = draft.tick.vehicles.front();
        const double x = car.position().x();
        car.mutable_position().mutate_x(std::nextafter(x, 1e9));
    });
    ASSERT_TRUE(found);
    EXPECT_EQ(found->states.different, 1U);
    EXPECT_EQ(found->states.first->what, "ego#1 x");
    EXPECT_EQ(found->states.first->tick, 60U);
    EXPECT_NE(found->states.first->expected, found->states.first->found);
}

TEST_F(GoldenOf, SeverityIsTheWorstThatChanged) {
    const auto failed =
        difference(say(33, world::EventKind::check_failed, "gap", "1 is less than 2"));
    ASSERT_TRUE(failed);
    EXPECT_EQ(failed->severity, Severity::verdicts);
    EXPECT_EQ(failed->verdicts.front().what, "check 'gap'");
    const auto printed = difference(say(33, world::EventKind::printed, "hello"));
    ASSERT_TRUE(printed);
    EXPECT_EQ(printed->severity, Severity::events);
    EXPECT_THAT(printed->events.first->found, HasSubstr("1.65 s printed 'hello'"));
    EXPECT_EQ(printed->events.first->line, 12U);
}

TEST_F(GoldenOf, NameOfACheckMayHaveAColon) {
    const Golden run =
        golden({.change = say(33, world::EventKind::check_failed, "ego: hits", "it happened")});
    ASSERT_THAT(run.checks, SizeIs(1));
    EXPECT_EQ(run.checks[0].name, "ego: hits");
    EXPECT_EQ(run.checks[0].detail, "it happened");
    const Golden passed =
        golden({.change = say(33, world::EventKind::check_passed, "ego: hits anything")});
    EXPECT_EQ(passed.checks.at(0).name, "ego: hits anything");
}

TEST_F(GoldenOf, AnotherValueOfACheckIsANumber) {
    const auto with = [&](const char* detail) {
        return golden({.change = say(150, world::EventKind::check_passed, "gap", detail)});
    };
    const auto found = compare(with("at least 9, allowed 2"), with("at least 8, allowed 2"));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->severity, Severity::numbers);
    EXPECT_THAT(found->details, SizeIs(1));
    EXPECT_THAT(found->verdicts, IsEmpty());
}

TEST_F(GoldenOf, ShorterRunIsNoticed) {
    const auto found = compare(golden({.ticks = 150}), golden({.ticks = 149}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->severity, Severity::events);
}

/// The same drive from another start is the same drive: the chain differs, nothing else.
TEST_F(GoldenOf, AnotherStartAloneIsNoReasonToFail) {
    const Golden before = golden({.seed = 7});
    const Golden now = golden({.seed = 8});
    EXPECT_NE(before.chain, now.chain);
    EXPECT_EQ(compare(before, now), std::nullopt);
    const std::vector<Changed> starts = start_differences(before, now);
    ASSERT_THAT(starts, SizeIs(1));
    EXPECT_EQ(starts.front().what, "seed");
    EXPECT_EQ(starts.front().expected, "7");
    EXPECT_EQ(starts.front().found, "8");
}

}  // namespace
}  // namespace reprise::replay

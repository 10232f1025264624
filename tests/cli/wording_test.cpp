// What commands print, as language: over their real outputs on runs with none, one and two of
// everything.
#include <regex>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

/// What no person would write.
const std::vector<std::pair<const char*, std::regex>>& blunders() {
    static const std::vector<std::pair<const char*, std::regex>> list{
        {"a plural of one",
         std::regex(
             R"((^|[^0-9.,:_-])1 (ticks|checks|cars|walkers|vehicles|events|collisions|lanes|)"
             R"(junctions|signals|pictures|messages|frames|pairs|values|differences|)"
             R"(triangles|polygons|warnings|roads|crossings|heads|actors|commands)\b)")},
        {"an article that does not fit",
         std::regex(R"(\ba [aeiou][a-z]+\b|\ban [bcdfgjkpqstvwz][a-z]+\b)")},
        {"a zero with a sign", std::regex(R"((^|[^0-9a-z.])-0(\.0+)?([^0-9.]|$))")},
        {"words that ran into each other", std::regex(R"([a-z0-9](recorded|golden) [0-9a-f]{8})")},
        {"seconds without two decimals",
         std::regex(R"(\b(at|=|,|after) [0-9]+(\.[0-9]|\.[0-9]{3,})? s\b)")},
    };
    return list;
}

void expect_fine(const std::string& command, const std::string& text) {
    for (const auto& [what, pattern] : blunders()) {
        std::smatch found;
        EXPECT_FALSE(std::regex_search(text, found, pattern))
            << command << ": " << what << ": '" << found.str() << "' in\n"
            << text;
    }
}

/// So many cars, checks, collisions, printed lines.
std::string scenario_with(int count) {
    std::string body =
        "  local ego = spawn{ name = 'ego', model = 'sedan', driver = 'manual', lane "
        "= 'east_1', s = 100, speed = 10 }\n"
        "  ego:control{ throttle = 0.4 }\n";
    for (int i = 0; i < count; ++i)
        body += "  spawn{ name = 'p" + std::to_string(i) +
                "', model = 'hatchback', driver = 'parked', lane = 'east_" + std::to_string(i + 1) +
                "', s = " + std::to_string(115 + 20 * i) + " }\n  check.never('c" +
                std::to_string(i) + "', function() return ego:collided() end)\n" +
                "  print(string.format('%.1f km/h', -0.01))\n";
    return "return scenario 'some' { town = 'straight', cars = " + std::to_string(count) +
           ", duration = 3, params = { x = 0 }, run = function()\n" + body + "  wait(60)\nend }";
}

class Wording : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Counts, Wording, testing::Values(0, 1, 2));

TEST_P(Wording, OfEveryCommandIsLanguage) {
    const Folder folder;
    write_file(folder / "some.lua", scenario_with(GetParam()));
    const std::string length = GetParam() == 1 ? "0.05" : "3";
    for (const std::string& command :
         std::vector<std::string>{"run some.lua -o a.mcap --for " + length,
                                  "run some.lua -o b.mcap --seed 9 --for 2.9",
                                  "verify a.mcap",
                                  "info a.mcap",
                                  "info b.mcap --long",
                                  "stats a.mcap",
                                  "stats b.mcap",
                                  "score a.mcap",
                                  "score b.mcap",
                                  "diff a.mcap b.mcap --all",
                                  "diff a.mcap a.mcap",
                                  "diff a.mcap a.mcap --tolerance 1e-6",
                                  "slice b.mcap --ticks 5 -o one.mcap",
                                  "info one.mcap",
                                  "strip a.mcap -o s.mcap --level inputs",
                                  "expand s.mcap -o full.mcap",
                                  "recover a.mcap -o r.mcap",
                                  "export a.mcap --to jsonl -o a.jsonl",
                                  "export a.mcap --to foxglove -o f.mcap",
                                  "branch b.mcap --at 1s --set x=1 -o br.mcap",
                                  "accept some.lua --because 'first golden'",
                                  "test some.lua",
                                  "test some.lua --checks",
                                  "town check straight"}) {
        const Result result = typed("reprise " + command, folder);
        EXPECT_NE(result.code, 2) << command << "\n" << result.out;
        expect_fine(command, result.out);
    }
}

}  // namespace
}  // namespace reprise::test

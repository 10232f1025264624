#include <cstdint>
#include <ostream>

#include "tests/scripting/hostile.h"

namespace reprise::test {

namespace {

constexpr const char* scenario = "\nreturn scenario 'test' { run = function() end }";
constexpr const char* branches = "more than 10,000 of 'and', 'or', 'elseif'";
constexpr const char* lookups = "too many variables in functions inside functions";
constexpr const char* hashes = "too many names, texts or numbers whose hashes agree";
constexpr const char* many = "more than 65,536 different names, texts and numbers";
constexpr const char* nested = "blocks and brackets are nested more than 190 deep";
constexpr const char* long_word = "a name or text of more than 64 kB";

LazyText numbered(int count, const std::string& before, const std::string& behind) {
    return std::function<std::string()>([=] {
        std::string all;
        for (int i = 1; i <= count; ++i)
            all += before + std::to_string(i) + behind;
        return all;
    });
}

LazyText file(const LazyText& text) {
    return text + scenario;
}

/// A function in a function in ..., each with so many variables; behind them the text.
LazyText functions(int depth, int variables, const LazyText& text) {
    std::string names = "v";
    for (int i = 1; i < variables; ++i)
        names += ",v" + std::to_string(i);
    return file(times(depth, "local function f() local " + names + " ") + text +
                times(depth, " end"));
}

LazyText multiples(std::int64_t factor, int count) {
    const LazyText list = std::function<std::string()>([=] {
        std::string all;
        for (int i = 1; i <= count; ++i)
            all += std::to_string(factor * i) + ",";
        return all;
    });
    return file("local t = {" + list + "}");
}

}  // namespace

void PrintTo(const Hostile& script, std::ostream* out) {
    *out << script.name;
}

LazyText times(int count, const LazyText& text) {
    return std::function<std::string()>([=] {
        const std::string one = text.made();
        std::string all;
        all.reserve(one.size() * static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i)
            all += one;
        return all;
    });
}

std::vector<Hostile> hostile_loads() {
    return {
        {"Or", file("local a local x = " + times(190'000, "a or ") + "a"), branches},
        {"And", file("local a local x = " + times(150'000, "a and ") + "a"), branches},
        {"OrAnd", file("local a local x = " + times(80'000, "a or a and ") + "a"), branches},
        {"OrOfComparisons",
         file("local a if " + times(110'000, "a==1 or ") + "a then end"),
         branches},
        {"NotOr", file("local a local x = " + times(100'000, "not a or ") + "a"), branches},
        {"Elseif", file("local a if a then " + times(65'000, "elseif a then ") + "end"), branches},
        {"Breaks",
         file("local a while a do " + times(30'000, "if a then break end ") + "end"),
         branches},
        {"Labels", file(numbered(32'000, "::l", ":: f=1 ")), branches},
        {"LabelsAndGotos",
         file("do " + times(30'000, "goto z ") + numbered(30'000, "::l", ":: f=1 ") + "::z:: end"),
         branches},
        {"AsManyAsAllowed", file("local a local x = " + times(9'999, "a or ") + "a"), ""},
        {"Functions", functions(180, 195, times(100'000, "x=x ")), lookups},
        {"FunctionsThatHold", functions(180, 195, times(100'000, "v=v1 ")), lookups},
        {"IntegersWhoseHashesAgree", multiples(65'535, 65'000), hashes},
        {"FewerIntegersWhoseHashesAgree", multiples(32'767, 32'767), hashes},
        {"FloatsWhoseHashesAgree",
         file("local t={" + numbered(60'000, "1.00000000", ",") + "}"),
         hashes},
        {"Names", file("local t={" + numbered(90'000, "a", "=1,") + "}"), many},
        {"Floats", file("local t={" + numbered(100'000, "", ".5,") + "}"), many},
        {"Brackets", file("local x = " + times(900'000, "(")), nested},
        {"Tables", file("local x = " + times(900'000, "{")), nested},
        {"Blocks", file(times(200'000, "do ")), nested},
        {"FunctionsInFunctions", file(times(50'000, "local f=function() ")), nested},
        {"Unary", file("local x = " + times(400'000, "- ") + "1"), "C stack overflow"},
        {"Concatenation", file("local x = " + times(300'000, "a..") + "a"), "C stack overflow"},
        {"LongText", file("local x = '" + times(900'000, "f") + "'"), long_word},
        {"LongBracketText", file("local x = [[" + times(900'000, "f") + "]]"), long_word},
        {"LongName", file("local " + times(900'000, "f")), long_word},
        {"LongNumber", file("local x = " + times(900'000, "9")), ""},
        {"LongHexadecimal", file("local x = 0x" + times(900'000, "f") + "p1"), ""},
        {"LongComment", file("--[[" + times(900'000, "f") + "]]"), ""},
        {"ManyLines", file(times(900'000, "\n")), ""},
        {"ManyFunctions", file("local t={" + times(65'000, "function()end,") + "}"), ""},
        {"LongList", file("local t={" + times(450'000, "1,") + "}"), ""},
        {"LargerThanAMegabyte", file(times(1'100'000, " ")), "more than 1 MB"},
        {"LoopInTheHeader", file("while true do end"), spent_in_a_load},
        {"WorkInTheHeader",
         file("local s = ('a'):rep(60000) local p = '%f[' .. ('b'):rep(60000) .. ']' while true do "
              "s:find(p) end"),
         spent_in_a_load},
    };
}

}  // namespace reprise::test

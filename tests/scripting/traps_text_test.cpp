#include <clocale>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripting/lua/text.h"
#include "tests/scripting/stage.h"
#include "world/check.h"

// Traps of Lua, by their numbers in docs/lua-traps.md: texts and numbers.
namespace reprise::scripting {

using test::mistake;
using test::printed;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

TEST(Trap07, NothingPrintsAnAddress) {
    for (const char* value : {"{}",
                              "print",
                              "function() end",
                              "pairs",
                              "string.format",
                              "ipairs({})",
                              "('a'):gmatch('a')",
                              "setmetatable({}, {})"})
        for (const char* text :
             {"tostring(%)", "string.format('%s', %)", "select(2, pcall(error, (%)))"}) {
            std::string body = text;
            body.replace(body.rfind('%'), 1, value);
            if (body.find("'%'") != std::string::npos)
                continue;
            EXPECT_THAT(printed("print(" + body + ")"),
                        ElementsAre(testing::AnyOf("table", "function")))
                << body;
        }
    EXPECT_EQ(mistake("error({})"), "test.lua:1: error with a table instead of a message");
    EXPECT_THAT(mistake("local t = {} .. 'x'"), HasSubstr("attempt to concatenate a table value"));
    EXPECT_THAT(mistake("print(setmetatable({}, { __name = 'car' }) + 1)"),
                HasSubstr("attempt to perform arithmetic on a car value"));
}

TEST(Trap08, FormatHasNoAddresses) {
    for (const char* format : {"%p", "%-20p", "%%%p", "%d %p"})
        EXPECT_THAT(mistake(std::string("string.format('") + format + "', 1, {})"),
                    HasSubstr("%p would show an address"))
            << format;
}

TEST(Trap08, FormatWritesNoMinusBeforeZero) {
    EXPECT_THAT(printed("print(string.format('%.1f %5.1f|%.0f %f %g %+.1f', -0.04, -0.0, -0.5, "
                        "-0.0, -0.0, -0.04))"),
                ElementsAre("0.0   0.0|0 0.000000 0 +0.0"));
    EXPECT_THAT(printed("print(string.format('%.1f %.2f %f %g %d %s', -0.06, -0.04, -1e-6, -1e-9, "
                        "-1, -0.5))"),
                ElementsAre("-0.1 -0.04 -0.000001 -1e-09 -1 -0.5"));
}

namespace {

/// A locale of its own making (localedef, of the package locales), taken while this lives.
class Locale {
  public:
    Locale(const std::string& language, const std::string& letters)
        : before_(std::setlocale(LC_ALL, nullptr)) {
        std::string pattern = (fs::temp_directory_path() / "reprise_locale_XXXXXX").string();
        if (mkdtemp(pattern.data()) == nullptr)
            throw std::runtime_error("mkdtemp");
        folder_ = pattern;
        const std::string name = language + "." + letters;
        // 1 is for warnings as well: what counts is that the locale can be taken.
        const std::string command = "localedef -i " + language + " -f " + letters + " '" +
                                    (folder_ / name).string() + "' >/dev/null 2>&1";
        [[maybe_unused]] const int code = std::system(command.c_str());
        setenv("LOCPATH", folder_.c_str(), 1);
        taken_ = std::setlocale(LC_ALL, name.c_str()) != nullptr;
    }

    ~Locale() {
        std::setlocale(LC_ALL, before_.c_str());
        unsetenv("LOCPATH");
        fs::remove_all(folder_);
    }

    Locale(const Locale&) = delete;
    Locale& operator=(const Locale&) = delete;

    bool taken() const { return taken_; }

  private:
    std::string before_;
    fs::path folder_;
    bool taken_ = false;
};

constexpr const char* no_locale = "no such locale: localedef of the package locales is missing";

std::vector<std::string> order_and_numbers() {
    return printed(R"(
        local words = { 'b', 'B', 'a', '_', 'Z', 'z', '\xe4', 'a\0b', 'a\0a' }
        table.sort(words)
        print(table.concat(words, ' '))
        print('a' < 'B', 'Z' < 'a', 1.5, tostring(1.5), string.format('%.2f', 1.5), 1.5 .. '', tonumber '1,5')
        print(('\xe4'):find('%a'), ('\xe4'):upper() == '\xe4'))");
}

}  // namespace

/// Lua asks the C library's strcoll for the order of texts; the one it finds is ours. Where a
/// locale has another order but a point in its numbers, nothing changes; where it has a comma, or
/// letters beyond ASCII, no script runs: none could see one.
TEST(Trap21, TextsCompareByBytesAndNumbersHavePointsInEveryLocale) {
    void* const found = dlsym(RTLD_DEFAULT, "strcoll");
    Dl_info info{};
    ASSERT_NE(dladdr(found, &info), 0);
    Dl_info here{};
    ASSERT_NE(dladdr(reinterpret_cast<void*>(&printable), &here), 0);
    EXPECT_STREQ(info.dli_fname, here.dli_fname);

    const std::vector<std::string> plain = order_and_numbers();
    EXPECT_THAT(
        plain,
        ElementsAre(
            "B Z _ a a\\x00a a\\x00b b z \\xe4", "false true 1.5 1.5 1.50 1.5 nil", "nil true"));
    {
        const Locale english("en_US", "UTF-8");
        ASSERT_TRUE(english.taken()) << no_locale;
        ASSERT_STREQ(std::localeconv()->decimal_point, ".");
        ASSERT_LT(std::strcmp("Z", "a"), 0) << "by bytes; by the locale's order it is behind";
        EXPECT_EQ(order_and_numbers(), plain);
    }
    {
        const Locale german("de_DE", "UTF-8");
        ASSERT_TRUE(german.taken()) << no_locale;
        ASSERT_STREQ(std::localeconv()->decimal_point, ",");
        EXPECT_THROW(printed("print(1.5)"), world::CheckFailed);
    }
    {
        const Locale swiss("de_CH", "ISO-8859-1");
        ASSERT_TRUE(swiss.taken()) << no_locale;
        ASSERT_STREQ(std::localeconv()->decimal_point, ".");
        EXPECT_THROW(printed("print(('\xe4'):upper())"), world::CheckFailed);
    }
    EXPECT_EQ(order_and_numbers(), plain) << "and afterwards all is as before";
}

/// A library that sets a locale in the middle of a run: the next tick does not begin.
TEST(Trap21, ALocaleWithADecimalCommaEndsARunThatIsOnItsWay) {
    test::Stage stage(test::running("while true do print(1.5) wait_ticks(1) end"));
    EXPECT_EQ(stage.step().tick.events.at(0).text, "1.5");
    const Locale german("de_DE", "UTF-8");
    ASSERT_TRUE(german.taken()) << no_locale;
    try {
        stage.step();
        FAIL() << "it went on";
    } catch (const world::CheckFailed& failure) {
        EXPECT_THAT(failure.what(), HasSubstr("writes numbers with ','"));
    }
}

// Closed for all of ours; documented for `..` of a float, which is an instruction of Lua's.
TEST(Trap22, FloatsPrintSoThatTheyReadBack) {
    EXPECT_THAT(printed(R"(
        local third, sum = 1 / 3, 0.1 + 0.2
        for _, text in ipairs{ tostring(sum), string.format('%s', sum), table.concat({ sum }),
                               (('x'):gsub('x', sum)), (('x'):gsub('x', function() return sum end)) } do
            assert(tonumber(text) == sum, text)
        end
        print(sum, third, 0 / 0, -(0 / 0), 1e15, 2^53, -0.0, 1e100, 5e-324))"),
                ElementsAre("0.30000000000000004 0.3333333333333333 nan nan 1e+15 "
                            "9007199254740992.0 -0.0 1e+100 5e-324"));
    EXPECT_THAT(printed("local sum = 0.1 + 0.2 print(sum .. '', 1.0 .. '', 100 .. '', 2.5 .. '')"),
                ElementsAre("0.3 1.0 100 2.5"));
}

TEST(Trap23, MathIsThatOfTheProgramLuaAsks) {
    // reprise-run carries its own mathematical library, and checks at its start that Lua is bound
    // to it; here: that sandboxed math adds nothing of its own.
    EXPECT_THAT(
        printed("print(math.sin(0.5), math.exp(0.5), 0.5 ^ 0.3, math.atan(1, 2))"),
        ElementsAre(number_text(std::sin(0.5)) + " " + number_text(std::exp(0.5)) + " " +
                    number_text(std::pow(0.5, 0.3)) + " " + number_text(std::atan2(1.0, 2.0))));
}

TEST(Trap24, SumsAreNotFusedAndTinyNumbersNotFlushed) {
    // x * x - y with y the rounded square is 0 when nothing is fused, 2^-54 off when it is.
    EXPECT_THAT(printed("local x = 1 + 2^-27 local y = x * x print(x * x - y) "
                        "print(2^-1074 > 0, 2^-1022 / 4 * 4 == 2^-1022) "
                        "print(0.1 + 0.2 == 0.3, 1e16 + 1 - 1e16)"),
                ElementsAre("0.0", "true true", "false 0.0"));
}

// Documented: integers and floats are two kinds of numbers.
TEST(Trap25, IntegersAndFloatsFollowTheManual) {
    EXPECT_THAT(
        printed("print(2^53, 1e15, 7 // 0.0, 10 // 0.3, -7 % 2, -7 // 2, 3 | 0, 7 / 2, 4 / 2) "
                "print(1 == 1.0, math.type(1), math.type(1.0), ({ [1] = 'a' })[1.0])"),
        ElementsAre("9007199254740992.0 1e+15 inf 33.0 1 -4 3 3.5 2.0", "true integer float a"));
    EXPECT_THAT(mistake("print(7 // 0)"), HasSubstr("attempt to divide by zero"));
    EXPECT_THAT(mistake("print(1 << 'x')"), HasSubstr("bitwise operation on a string value"));
}

TEST(Trap29, MessagesNameTheFileWithoutItsFolder) {
    EXPECT_EQ(mistake("error 'mine'"), "test.lua:1: mine");
    EXPECT_THAT(
        printed(
            "print(select(2, pcall(error, 'mine')), select(2, pcall(function() error 'x' end)))"),
        ElementsAre("mine test.lua:1: x"));
}

TEST(Trap30, MessagesNameFunctionsByTheirCallNotByASearch) {
    EXPECT_THAT(mistake("math.floor({})"), HasSubstr("bad argument #1 to 'floor'"));
    EXPECT_THAT(mistake("local f = math.floor f({})"), HasSubstr("bad argument #1 to 'f'"));
}

// Documented: integers wrap around. Closed: texts are no numbers.
TEST(Trap43, TextsAreNoNumbersAndIntegersWrapAround) {
    for (const char* sum : {"'10' + 1", "1 + '10'", "'10' * '2'", "-'2'", "'7' // 2", "'2' ^ 3"})
        EXPECT_THAT(mistake(std::string("print(") + sum + ")"),
                    HasSubstr("attempt to perform arithmetic on a string value"))
            << sum;
    EXPECT_THAT(printed("print(math.maxinteger + 1 == math.mininteger) "
                        "for i = 1, 3 do if i == 2 then goto next end print(i) ::next:: end"),
                ElementsAre("true", "1", "3"));
}

// Documented: string functions know bytes and ASCII; utf8 knows characters.
TEST(Trap44, StringsAreBytesAndLettersAreAscii) {
    EXPECT_THAT(printed(R"(
        print(#'\u{e4}', ('\u{e4}bc'):upper(), utf8.len('\u{e4}bc'), ('\u{e4}'):find('%w'))
        for _, class in ipairs{ '%a', '%d', '%l', '%s', '%u', '%w', '%x', '%p', '%c', '%g' } do
            local count = 0
            for byte = 0, 255 do if string.char(byte):find(class) then count = count + 1 end end
            print(class, count)
        end)"),
                ElementsAre("2 \xc3\xa4"
                            "BC 3 nil",
                            "%a 52",
                            "%d 10",
                            "%l 26",
                            "%s 6",
                            "%u 26",
                            "%w 62",
                            "%x 22",
                            "%p 32",
                            "%c 33",
                            "%g 94"));
}

TEST(Text, WhatATerminalWouldObeyIsWrittenOut) {
    EXPECT_THAT(printed("print('\\27[2J\\27[31mred\\r\\8', '\\7', '\\u{9b}31m', '\\127', 'a\\tb')"),
                ElementsAre("\\x1b[2J\\x1b[31mred\\x0d\\x08 \\x07 \\xc2\\x9b31m \\x7f a\tb"));
    EXPECT_THAT(printed("print('\\xff', '\\xc3', '\\xe2\\x82', '\\xed\\xa0\\x80', '\\xc0\\xaf', "
                        "'\\u{20ac}', '\\u{1f600}', '\\xf5\\x80\\x80\\x80')"),
                ElementsAre("\\xff \\xc3 \\xe2\\x82 \\xed\\xa0\\x80 \\xc0\\xaf \xe2\x82\xac "
                            "\xf0\x9f\x98\x80 \\xf5\\x80\\x80\\x80"));
    EXPECT_THAT(printed("print 'one\\ntwo\\n'"), ElementsAre("one", "two", ""));
    EXPECT_EQ(mistake("error('\\27[2Jgone\\nsecond line', 0)"), "test.lua:1: \\x1b[2Jgone");
    EXPECT_EQ(mistake("spawn{ model = 'sedan', name = '\\27[2J' }"),
              "test.lua:1: spawn: 'name' holds what cannot be shown: '\\x1b[2J'");
    EXPECT_EQ(mistake("check.never(('x'):rep(101), print)"),
              "test.lua:1: check.never: the name must have 1 to 100 characters, has 101");
    test::Stage stage(test::running("finish '\\27c'"));
    stage.play(1);
    EXPECT_EQ(stage.reason(), "\\x1bc");
}

}  // namespace reprise::scripting

#include "scripting/lua/patterns.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lua.hpp>

#include "tests/scripting/stage.h"
#include "world/random.h"

namespace reprise::scripting {

using test::mistake;
using test::printed;
using testing::HasSubstr;

namespace {

/// What a chunk returns in Lua's own string library, its results joined; "error" when it fails.
std::string stock(const std::string& chunk) {
    lua_State* const L = luaL_newstate();
    luaL_openlibs(L);
    std::string answer = "error";
    if (luaL_dostring(L, chunk.c_str()) == LUA_OK) {
        answer.clear();
        for (int index = 1; index <= lua_gettop(L); ++index)
            answer += std::string(index == 1 ? "" : " ") + luaL_tolstring(L, index, nullptr),
                lua_pop(L, 1);
    }
    lua_close(L);
    return answer;
}

/// The same in ours.
std::string ours(const std::string& chunk) {
    const auto lines = printed("print(pcall(function() " + chunk + " end))");
    if (lines.size() != 1)
        return "";
    return lines[0].rfind("true", 0) == 0
               ? lines[0].substr(std::min<std::size_t>(5, lines[0].size()))
               : "error";
}

/// A text of such letters; a function of the item.
std::string text_of_letters(const std::string& letters, std::uint64_t item, std::size_t longest) {
    const auto draw = [&](std::uint64_t place) {
        return world::draw(7, item, world::Purpose::scenario, place);
    };
    std::string text(static_cast<std::size_t>(draw(0) * static_cast<double>(longest + 1)), ' ');
    for (std::size_t i = 0; i < text.size(); ++i)
        text[i] =
            letters[static_cast<std::size_t>(draw(i + 1) * static_cast<double>(letters.size()))];
    return text;
}

}  // namespace

TEST(Patterns, AnswerAsLuasOwnDo) {
    int found = 0;
    int mistaken = 0;
    for (std::uint64_t item = 0; item < 1500; ++item) {
        const std::string text = text_of_letters("aab(1) ", 2 * item, 12);
        const std::string wanted = text_of_letters("aab1.*+-?()[]^$%%wdsb1f", 2 * item + 1, 7);
        const std::string arguments = "'" + text + "', [==[" + wanted + "]==]";
        for (const std::string& call :
             {"return string.find(" + arguments + ")",
              "return string.match(" + arguments + ", 3)",
              "return string.gsub(" + arguments + ", '<%0>')",
              "return string.gsub(" + arguments + ", function(...) return #{ ... } end)"}) {
            const std::string expected = stock(call);
            ASSERT_EQ(ours(call), expected) << call;
            (expected == "error" ? mistaken : found) += expected == "nil" ? 0 : 1;
        }
        if (wanted.empty() || wanted.front() == '^')
            continue;  // refused: there it would be a letter
        const std::string walk = "local t = {} for a, b in string.gmatch(" + arguments +
                                 ") do t[#t + 1] = tostring(a) .. '|' .. tostring(b) end "
                                 "return #t, t[1], t[2], t[#t]";
        ASSERT_EQ(ours(walk), stock(walk)) << walk;
    }
    EXPECT_GT(found, 1000);
    EXPECT_GT(mistaken, 500);
}

TEST(Patterns, AnswerAsLuasOwnDoInUsefulCases) {
    for (const char* call :
         {"return ('key = value'):match('^(%w+)%s*=%s*(%w+)$')",
          "return ('  trim  '):match('^%s*(.-)%s*$')",
          "return ('THE (quick) fox'):find('%f[%a]%a+%f[%A]')",
          "return ('f(a(b)c)d'):match('%b()')",
          "return ('\"quoted\" text'):match([[([\"'])(.-)%1]])",
          "return ('a.b'):find('.', 1, true)",
          "return ('abc'):find('b', -1), ('abc'):find('', 10), ('abc'):find('', 4)",
          "return ('hello'):gsub('', '-')",
          "return ('abc'):gsub('%w', { a = '1', b = false })",
          "return ('5%'):gsub('%%', '%%%%')",
          "return ('a,b'):gsub('(%w),(%w)', '%2,%1')",
          "return ('abc'):gsub('%w', '%0%0', 2)",
          "return ('2026-11-21'):match('(%d+)-(%d+)-(%d+)')",
          "return ('x'):rep(300):match('^x*$') == ('x'):rep(300)"})
        EXPECT_EQ(ours(call), stock(call)) << call;
}

TEST(Patterns, MistakesInThemAreOneLine) {
    for (const auto& [pattern, message] : std::vector<std::pair<std::string, std::string>>{
             {"%", "malformed pattern: it ends with '%'"},
             {"[a", "malformed pattern: ']' is missing"},
             {"[a%", "malformed pattern: ']' is missing"},
             {"(a))", "malformed pattern: ')' without '('"},
             {"(a", "unfinished capture"},
             {"%b", "'%b' needs two characters"},
             {"%f", "'[' is missing after '%f'"},
             {"%1", "invalid capture index %1"}})
        EXPECT_THAT(mistake("string.find('aaa', '" + pattern + "')"), HasSubstr(message))
            << pattern;
    EXPECT_THAT(mistake("string.gsub('a', 'a', '%2')"), HasSubstr("invalid capture index"));
    EXPECT_THAT(mistake("string.gsub('a', 'a', '%x')"), HasSubstr("invalid use of '%'"));
    EXPECT_THAT(mistake("string.gsub('a', 'a', function() return {} end)"),
                HasSubstr("the replacement must be a string, got table"));
}

TEST(Patterns, StepsGrowAsTheBacktrackingDoes) {
    const auto steps = [](std::size_t size, const char* wanted) {
        const std::string text(size, 'a');
        std::uint64_t paid = 0;
        Pattern pattern(text, wanted, [&](std::uint64_t more) { paid += more; });
        EXPECT_FALSE(pattern.match_at(0).has_value());
        pattern.settle();
        return paid;
    };
    EXPECT_GE(steps(100, ".-.-b"), 100U * 100U / 2U);
    EXPECT_GT(steps(200, ".-.-b"), 3 * steps(100, ".-.-b"));
    EXPECT_LT(steps(1000, "b"), 10U);
}

}  // namespace reprise::scripting

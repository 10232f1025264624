#include "scripting/lua/literals.h"

#include <gtest/gtest.h>

namespace reprise::scripting {

TEST(Literals, ReadBackAsWhatTheyWere) {
    const std::vector<Value> values{true,
                                    false,
                                    std::int64_t{0},
                                    std::int64_t{-12},
                                    std::int64_t{9223372036854775807},
                                    45.0,
                                    0.1 + 0.2,
                                    -1e300,
                                    5e-324,
                                    std::string(),
                                    std::string("it's\n\\ a\r 'test'"),
                                    std::string("a\0b", 3),
                                    std::string("12")};
    for (const Value& value : values)
        EXPECT_EQ(parse_literal(literal(value)), value) << literal(value);
}

TEST(Literals, AreShortAndKeepTheirType) {
    EXPECT_EQ(literal(std::int64_t{12}), "12");
    EXPECT_EQ(literal(12.0), "12.0");
    EXPECT_EQ(literal(0.1), "0.1");
    EXPECT_EQ(literal(std::string("a'b")), "'a\\'b'");
}

TEST(Literals, CodeIsNoLiteral) {
    for (const char* text :
         {"", "nil", "f()", "1 + 1", "'a' .. 'b'", "'a", "{}", "0x", "1e999", "nan", "12 "})
        EXPECT_FALSE(parse_literal(text).has_value()) << text;
}

}  // namespace reprise::scripting

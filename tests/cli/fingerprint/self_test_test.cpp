#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

using testing::HasSubstr;

/// A library that the dynamic linker loads before all others, and the word of the refusal.
struct Preloaded {
    const char* name;
    const char* code;
    const char* refusal;
};

void PrintTo(const Preloaded& preloaded, std::ostream* out) {
    *out << preloaded.name;
}

class SelfTest : public testing::TestWithParam<Preloaded> {};

TEST_P(SelfTest, RefusesToRecordOrVerifyUnderAPreloadedLibraryThatSpoilsTheNumbers) {
    const Folder folder;
    const std::string trace = folder / "good.mcap";
    const std::vector<std::string> drive{
        "run", source("scenarios/child_runs_out.lua"), "--for", "0.2", "-o"};
    std::vector<std::string> words = drive;
    words.push_back(trace);
    ASSERT_EQ(reprise(words).code, 1);  // its checks need a longer run

    const std::string code = folder / "spoil.c";
    const std::string library = folder / "spoil.so";
    write_file(code, GetParam().code);
    ASSERT_EQ(run_program("cc", {"-shared", "-fPIC", "-o", library, code}).code, 0);
    words.back() = folder / "spoilt.mcap";
    setenv("LD_PRELOAD", library.c_str(), 1);
    const Result run = reprise(words);
    const Result verify = reprise({"verify", trace});
    unsetenv("LD_PRELOAD");

    for (const Result& result : {run, verify}) {
        EXPECT_EQ(result.code, 2);
        EXPECT_THAT(result.out, HasSubstr("reprise: self-test: "));
        EXPECT_THAT(result.out, HasSubstr(GetParam().refusal));
    }
    EXPECT_THAT(folder.files(), testing::ElementsAre("good.mcap", "spoil.c", "spoil.so"));
}

INSTANTIATE_TEST_SUITE_P(
    Of,
    SelfTest,
    testing::Values(Preloaded{"DenormalResults",
                              "#include <xmmintrin.h>\n"
                              "__attribute__((constructor)) static void spoil(void) {\n"
                              "    _mm_setcsr(_mm_getcsr() | 0x8000);\n}\n",
                              "flushed to zero"},
                    Preloaded{"DenormalNumbers",
                              "#include <xmmintrin.h>\n"
                              "__attribute__((constructor)) static void spoil(void) {\n"
                              "    _mm_setcsr(_mm_getcsr() | 0x0040);\n}\n",
                              "taken for zero"},
                    Preloaded{"Rounding",
                              "#include <xmmintrin.h>\n"
                              "__attribute__((constructor)) static void spoil(void) {\n"
                              "    _mm_setcsr(_mm_getcsr() | 0x4000);\n}\n",
                              "not rounded to nearest"},
                    Preloaded{"X87Precision",
                              "__attribute__((constructor)) static void spoil(void) {\n"
                              "    unsigned short word = 0x027f;\n"
                              "    __asm__ volatile(\"fldcw %0\" : : \"m\"(word));\n}\n",
                              "x87"},
                    Preloaded{"DecimalPoint",
                              "#include <locale.h>\n"
                              "struct lconv* localeconv(void) {\n"
                              "    static struct lconv comma;\n"
                              "    comma.decimal_point = \",\";\n"
                              "    return &comma;\n}\n",
                              "with ',' instead of a point"},
                    Preloaded{"Sumo",
                              "double _ZN10GeomHelper7angle2DERK8PositionS2_(void* a, void* b) {\n"
                              "    return 0;\n}\n",
                              "SUMO computes with another libm"},
                    Preloaded{"Bullet",
                              "void _ZN11btRigidBody26predictIntegratedTransformEdR11btTransform(\n"
                              "    void* body, double step, void* pose) {}\n",
                              "Bullet computes with another libm"}),
    [](const auto& spoilt) { return std::string(spoilt.param.name); });

}  // namespace
}  // namespace reprise::test

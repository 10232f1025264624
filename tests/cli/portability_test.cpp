#include <cstdlib>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace reprise::test {
namespace {

/// glibc without fused multiply-add is what an older CPU, or qemu's Nehalem, gets. With glibc's own
/// libm runs of this town part ways between ticks 1,500 and 4,300; so 6,000 ticks.
TEST(Run, WritesTheSameBytesOnACpuWithoutFma) {
    const Folder folder;
    const std::vector<std::string> drive{
        "run", source("scenarios/free_drive.lua"), "--seed", "7", "--for", "300", "-o"};
    auto record = [&](const std::string& name) {
        std::vector<std::string> words = drive;
        words.push_back(folder / name);
        const Result run = reprise(words);
        EXPECT_EQ(run.code, 0) << run.out;
        return read_file(folder / name);
    };
    const std::string here = record("here.mcap");
    setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4", 1);
    const std::string elsewhere = record("elsewhere.mcap");
    unsetenv("GLIBC_TUNABLES");
    ASSERT_GT(here.size(), 1'000'000U);
    EXPECT_TRUE(here == elsewhere);
}

TEST(Run, IsNotChangedByAPreloadedMathLibrary) {
    const Folder folder;
    const std::string code = folder / "sin.c";
    write_file(code, "double sin(double x) { return x; }\n");
    ASSERT_EQ(std::system(("cc -shared -fPIC -o " + (folder / "sin.so") + " " + code).c_str()), 0);
    setenv("LD_PRELOAD", (folder / "sin.so").c_str(), 1);
    const Result run =
        reprise({"run", source("scenarios/free_drive.lua"), "--for", "1", "-o", folder / "t.mcap"});
    unsetenv("LD_PRELOAD");
    EXPECT_EQ(run.code, 0) << run.out;
    const Result plain =
        reprise({"run", source("scenarios/free_drive.lua"), "--for", "1", "-o", folder / "u.mcap"});
    EXPECT_EQ(plain.code, 0) << plain.out;
    EXPECT_TRUE(read_file(folder / "t.mcap") == read_file(folder / "u.mcap"));
}

}  // namespace
}  // namespace reprise::test

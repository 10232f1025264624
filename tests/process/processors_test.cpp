#include "process/processors.h"

#include <fstream>
#include <sched.h>

#include <gtest/gtest.h>

#include "tests/process/scratch.h"
#include "world/units.h"

namespace reprise::process {
namespace {

namespace fs = std::filesystem;

class GrantedProcessors : public test::Scratch {
  protected:
    void write(const fs::path& name, const std::string& text) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << text;
    }

    double granted() const { return granted_processors(folder_ / "groups", folder_ / "mounted"); }
};

TEST_F(GrantedProcessors, AreAllWhereNobodySaysElse) {
    EXPECT_EQ(granted(), world::infinity);
    write("groups", "0::/\n");
    EXPECT_EQ(granted(), world::infinity);
    write("mounted/cpu.max", "max 100000\n");
    EXPECT_EQ(granted(), world::infinity);
}

TEST_F(GrantedProcessors, AreTheLeastOfTheGroupsAboveOurs) {
    write("groups", "0::/user.slice/session.scope\n");
    write("mounted/user.slice/session.scope/cpu.max", "max 100000\n");
    write("mounted/user.slice/cpu.max", "250000 100000\n");
    EXPECT_EQ(granted(), 2.5);
    write("mounted/user.slice/session.scope/cpu.max", "50000 100000\n");
    EXPECT_EQ(granted(), 0.5);
}

/// Where the group's name is that outside, and what is mounted is the group itself.
TEST_F(GrantedProcessors, OfAContainerAreThoseOfWhatItSees) {
    write("groups", "0::/docker/0123456789ab\n");
    write("mounted/cpu.max", "100000 100000\n");
    EXPECT_EQ(granted(), 1);
}

TEST_F(GrantedProcessors, AreKnownOfTheFirstVersionOfGroups) {
    write("groups", "4:memory:/box\n1:cpu,cpuacct:/box\n0::/\n");
    write("mounted/cpu,cpuacct/cpu.cfs_quota_us", "-1\n");
    write("mounted/cpu,cpuacct/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(granted(), world::infinity);
    write("mounted/cpu,cpuacct/box/cpu.cfs_quota_us", "150000\n");
    write("mounted/cpu,cpuacct/box/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(granted(), 1.5);
}

TEST(Processors, AreThoseThatWeMayRunOn) {
    cpu_set_t before;
    ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
    EXPECT_LE(processors(), static_cast<std::size_t>(CPU_COUNT(&before)));
    EXPECT_GE(processors(), 1U);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int cpu = 0; CPU_COUNT(&one) == 0; ++cpu)
        if (CPU_ISSET(cpu, &before))
            CPU_SET(cpu, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
    EXPECT_EQ(processors(), 1U);
    ASSERT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
}

}  // namespace
}  // namespace reprise::process

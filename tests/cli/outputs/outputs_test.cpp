// Where outputs go, over every command that writes one.
#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <gmock/gmock.h>

#include "tests/cli/outputs/commands.h"

namespace reprise::test {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

class Outputs : public testing::TestWithParam<WritingCommand> {
  protected:
    void SetUp() override { give_inputs(folder_); }

    Result write_to(const std::string& out) { return reprise(GetParam().to(out), folder_.path()); }

    /// Names of everything that is there, folders and links too.
    std::vector<std::string> all() const {
        std::vector<std::string> names;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
            names.push_back(fs::relative(entry.path(), folder_.path()).string());
        std::sort(names.begin(), names.end());
        return names;
    }

    const Folder folder_;
};

TEST_P(Outputs, FollowLinksWhichStay) {
    fs::create_directory(folder_ / "real");
    fs::create_symlink("behind", folder_ / "link.mcap");
    fs::create_symlink("real/target.mcap", folder_ / "behind");
    const Result result = write_to("link.mcap");
    EXPECT_TRUE(fs::is_symlink(folder_ / "link.mcap"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "behind"));
    if (GetParam().makes_folder) {
        EXPECT_EQ(result.code, 2) << "a folder is named itself; " << result.out;
        return;
    }
    const int good = GetParam().name == "Recover" ? 3 : 0;  // what is cut has lost something
    EXPECT_EQ(result.code, good) << result.out;
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder_ / "real/target.mcap")));
    // A target that is there is replaced at once: who has it open keeps what it was.
    write_file(folder_ / "real/target.mcap", "before");
    const int before = open((folder_ / "real/target.mcap").c_str(), O_RDONLY);
    EXPECT_EQ(write_to("link.mcap").code, good);
    char bytes[7] = {};
    EXPECT_EQ(read(before, bytes, 6), 6);
    EXPECT_STREQ(bytes, "before");
    close(before);
    EXPECT_GT(fs::file_size(folder_ / "real/target.mcap"), 6U);
}

TEST_P(Outputs, NeverReplaceAPipeOrADevice) {
    ASSERT_EQ(mkfifo((folder_ / "pipe.mcap").c_str(), 0600), 0);
    std::vector<std::string> specials{"pipe.mcap"};
    // Nodes of our own: the machine's are not to be tried on. Only root makes them.
    if (mknod((folder_ / "full.mcap").c_str(), S_IFCHR | 0600, makedev(1, 7)) == 0)
        specials.push_back("full.mcap");
    if (!GetParam().streams)
        for (const std::string& special : {specials.front(), specials.back()}) {
            fs::create_symlink(special, folder_ / ("to_" + special));
            specials.push_back("to_" + special);
            if (specials.size() > 3)
                break;
        }
    else
        specials.erase(specials.begin());  // would wait for a reader
    const auto before = all();
    for (const std::string& special : specials) {
        struct stat was {};

        struct stat is {};

        lstat((folder_ / special).c_str(), &was);
        const Result result = write_to(special);
        EXPECT_EQ(result.code, 2) << special << ": " << result.out;
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
        EXPECT_THAT(result.out,
                    AnyOf(HasSubstr("not a plain file"),
                          HasSubstr("not a folder"),
                          HasSubstr("cannot be made a folder"),
                          HasSubstr("symbolic link"),
                          HasSubstr("No space left")));
        EXPECT_EQ(lstat((folder_ / special).c_str(), &is), 0);
        EXPECT_EQ(is.st_ino, was.st_ino) << special;
        EXPECT_EQ(is.st_mode, was.st_mode) << special;
    }
    EXPECT_EQ(all(), before);
}

TEST_P(Outputs, ThatNoFileCanBeAreToldInOneLine) {
    write_file(folder_ / "file", "");
    const std::string long_name(300, 'a');
    const auto before = all();
    for (const std::string& out : {long_name, std::string("file/a.mcap"), long_name + "/a"}) {
        const Result result = write_to(out);
        EXPECT_EQ(result.code, 2) << out << ": " << result.out;
        EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
        EXPECT_THAT(result.out, HasSubstr("reprise: "));
        EXPECT_EQ(all(), before) << out;
    }
}

TEST_P(Outputs, IntoTheStandardOutputAreTextOrNothing) {
    std::string line = "exec reprise";
    for (const std::string& word : GetParam().to("out"))
        line += " '" + (word == "out" ? "own/stdout" : word) + "'";
    fs::create_directory(folder_ / "own");
    // As /dev/stdout is made; that one is not to be tried on.
    fs::create_symlink("/proc/self/fd/1", folder_ / "own/stdout");
    const Result result = typed(line + " > said.txt", folder_);
    EXPECT_TRUE(fs::is_symlink(folder_ / "own/stdout"));
    EXPECT_EQ(result.code, GetParam().streams ? 0 : 2) << result.out;
    EXPECT_EQ(fs::file_size(folder_ / "said.txt") > 0, GetParam().streams);
    EXPECT_THAT(folder_.files(), testing::Not(testing::Contains(HasSubstr(".partial"))));
}

TEST_P(Outputs, SayThatFilesMayNotGrowSoLarge) {
    if (GetParam().name == "Get" || GetParam().name == "Junit")
        GTEST_SKIP() << "they write less than a shell can limit, or run programs that write more";
    const auto before = all();
    std::string line = "ulimit -f 1; exec reprise";
    for (const std::string& word : GetParam().to("out.mcap"))
        line += " '" + word + "'";
    const Result result = typed(line, folder_);
    if (GetParam().name == "Render" && result.code == 0)
        GTEST_SKIP() << "its pictures are small enough";
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_THAT(result.out, AnyOf(HasSubstr("ulimit -f"), HasSubstr("File size limit")));
    if (GetParam().name == "Run")
        return;  // what was recorded is kept
    EXPECT_EQ(all(), before);
}

INSTANTIATE_TEST_SUITE_P(Every,
                         Outputs,
                         testing::ValuesIn(writing_commands()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace reprise::test

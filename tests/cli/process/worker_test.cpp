#include "cli/process/worker.h"

#include <csignal>
#include <new>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "world/check.h"

namespace reprise::cli {
namespace {

using testing::HasSubstr;

std::string error_of(const std::function<std::string()>& work) {
    try {
        return "returned " + in_worker("x.osm", work);
    } catch (const world::Error& error) {
        return error.what();
    }
}

TEST(Worker, ReturnsWhatItsWorkReturns) {
    const std::string long_one(3'000'000, 'a');
    EXPECT_EQ(in_worker("x.osm", [&] { return long_one; }), long_one);
}

TEST(Worker, WorksInAProcessOfItsOwn) {
    int seen = 1;
    in_worker("x.osm", [&] {
        seen = 2;
        return "";
    });
    EXPECT_EQ(seen, 1);
}

TEST(Worker, ThrowsWhatItsWorkThrows) {
    EXPECT_EQ(error_of([]() -> std::string { throw world::Error("x.osm:3: is no map"); }),
              "x.osm:3: is no map");
    EXPECT_THAT(error_of([]() -> std::string { throw std::bad_alloc(); }),
                HasSubstr("x.osm: more than 8 GB of memory would be needed"));
    EXPECT_THROW(in_worker("x.osm", []() -> std::string { throw std::logic_error("ours"); }),
                 std::runtime_error);
}

TEST(Worker, ThatIsKilledLeavesUsAlive) {
    const auto work = []() -> std::string {
        kill(getpid(), SIGKILL);
        return "";
    };
    EXPECT_THROW(in_worker("x.osm", work), std::runtime_error);
    EXPECT_THAT(error_of([]() -> std::string {
                    std::signal(SIGXCPU, SIG_DFL);
                    raise(SIGXCPU);
                    return "";
                }),
                HasSubstr("it needed more than 600 s"));
}

TEST(Worker, IsEndedWhenWeAreToldToEnd) {
    int alive[2];  // the worker holds its end open as long as it lives
    ASSERT_EQ(pipe(alive), 0);
    const std::string said = error_of([&]() -> std::string {
        kill(getppid(), SIGTERM);
        pause();
        return "";
    });
    EXPECT_EQ(said, "stopped (Terminated)");
    close(alive[1]);
    char none = 0;
    EXPECT_EQ(read(alive[0], &none, 1), 0) << "nobody holds the other end";
    close(alive[0]);
}

}  // namespace
}  // namespace reprise::cli

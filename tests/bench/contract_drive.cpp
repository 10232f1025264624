// Drives among 100 cars, recorded, and prints the seconds of CPU that 1,200 ticks took. Built
// twice: as every run is, and plain: with glibc's maths and with the digests left out.
// contract_bench runs the two in turn.
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "kernel/kernel.h"
#include "replay/trace_writer.h"
#include "tests/bench/drive.h"

#ifdef REPRISE_PLAIN
// What the linker puts in the place of the hasher's work (--wrap).
extern "C" void __wrap__ZN7reprise5world6Hasher9add_bytesEPKvm(void*, const void*, std::size_t) {}

extern "C" std::uint64_t __wrap__ZNK7reprise5world6Hasher8digest64Ev(const void*) {
    return 0;
}
#endif

namespace {

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

int main(int, char** argv) {
    using namespace reprise;
    constexpr int warm_up = 200;
    constexpr int measured = 1200;
    const world::Recording recording = bench::free_drive(100);
    replay::TraceWriter trace(argv[1], recording);
    kernel::Kernel kernel(recording);
    for (int i = 0; i < warm_up; ++i)
        trace.append(kernel.step());
    const double begin = cpu_seconds();
    for (int i = 0; i < measured; ++i)
        trace.append(kernel.step());
    std::printf("%.9f\n", cpu_seconds() - begin);
    trace.close(kernel.outcome());
    return 0;
}

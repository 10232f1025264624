// libFuzzer at everything that reads traces: no input may crash, hang or be read out of bounds, and
// what is recovered is sound. Start: trace_fuzz --seeds FOLDER writes inputs; trace_fuzz FOLDER.
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <sys/mman.h>
#include <unistd.h>

#include "replay/chain_seed.h"
#include "replay/compare/divergence.h"
#include "replay/recovery.h"
#include "replay/trace_reader.h"
#include "tests/fuzz/finished_trace.h"
#include "tests/fuzz/seeds.h"
#include "tests/replay/synthetic_run.h"
#include "world/check.h"
#include "world/digest.h"

namespace {

using namespace reprise;
using replay::TraceReader;

/// Where inputs lie as files, in memory.
class Files {
  public:
    Files() { test::write_trace(reference(), {.ticks = 41, .cars = 2}); }

    std::filesystem::path input(replay::mcap::View bytes) const {
        if (::ftruncate(descriptor_, 0) != 0 ||
            ::pwrite(descriptor_, bytes.data(), bytes.size(), 0) !=
                static_cast<ssize_t>(bytes.size()))
            std::abort();
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

    std::filesystem::path reference() const { return folder_ / "reference.mcap"; }

    std::filesystem::path recovered() const { return folder_ / "recovered.mcap"; }

  private:
    int descriptor_ = ::memfd_create("input", 0);
    test::Folder folder_;
};

/// A trace that opens has ticks that say who they are, or says what is wrong with them.
void read_all(TraceReader& trace) {
    for (std::uint64_t index = trace.first(); index <= trace.last(); ++index) {
        if (trace.damage(index)) {
            (void)trace.salvaged(index);
            continue;
        }
        try {
            if (trace.tick(index).view.index() != index)
                std::abort();
        } catch (const world::Error&) {
        }
    }
    (void)trace.message_bytes();
    (void)trace.damage();
    (void)trace.recording();
}

void read_and_compare(const std::filesystem::path& input, const std::filesystem::path& reference) {
    try {
        TraceReader trace(input);
        TraceReader other(reference);
        try {
            read_all(trace);
        } catch (const world::Error&) {
        }
        (void)replay::compare(other, trace);
        replay::Tolerance tolerance{1e-3};
        (void)replay::compare(other, trace, tolerance);
    } catch (const world::Error&) {
    }
}

void recover(const std::filesystem::path& input, const std::filesystem::path& out) {
    try {
        replay::recover(input, out);
    } catch (const world::Error&) {
        if (std::filesystem::exists(out))
            std::abort();
        return;
    }
    TraceReader trace(out);
    world::Digest128 chain = trace.chain(0);
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index) {
        chain = world::chain(replay::chain_before(trace.episode(), index, chain),
                             trace.recorded(index).view.tick->digests()->state());
        if (!(chain == trace.chain(index)))
            std::abort();
    }
    if (trace.damage())
        std::abort();
    std::filesystem::remove(out);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    if (*argc == 3 && std::string_view((*argv)[1]) == "--seeds") {
        test::write_seeds((*argv)[2]);
        std::exit(0);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const Files files;
    if (size == 0)
        return 0;
    const replay::mcap::View rest(data + 1, size - 1);
    const std::filesystem::path path = data[0] % 2 == test::whole_file
                                           ? files.input(rest)
                                           : files.input(test::finished_trace(rest));
    read_and_compare(path, files.reference());
    recover(path, files.recovered());
    return 0;
}

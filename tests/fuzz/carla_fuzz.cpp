// libFuzzer at recordings of CARLA's recorder: whatever is in one, a trace of sound ticks comes
// out, or one line that says where the recording is wrong.
#include <algorithm>

#include "exchange/carla/carla_import.h"
#include "replay/trace_reader.h"
#include "tests/exchange/carla_logs.h"
#include "tests/fuzz/start.h"
#include "tests/replay/synthetic_run.h"
#include "world/check.h"

using namespace reprise;

namespace {

/// Simulated time costs; a log may pause for a minute between two frames.
constexpr std::uint64_t step_ns = 1'000'000'000;

exchange::CarlaBytes bytes_in(std::span<const std::uint8_t> log) {
    return {"x.log", log.size(), [log](std::uint64_t offset, std::span<std::uint8_t> out) {
                if (offset > log.size() || out.size() > log.size() - offset)
                    std::abort();
                std::copy_n(
                    log.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
            }};
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    return test::start_fuzzing(argc, argv, [](const std::filesystem::path& folder) {
        int number = 0;
        for (const char* options : {"--frames 2",
                                    "--frames 3 --additional",
                                    "--frames 3 --ue5 --additional",
                                    "--frames 40 --additional",
                                    "--frames 5 --cut 30"})
            test::write_seed(folder / std::to_string(number++), test::carla_log(options));
    });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::Folder folder;
    const std::filesystem::path out = folder / "out.mcap";
    exchange::CarlaImportOptions options;
    options.name = "x.log";
    options.timing = {step_ns, [](double, double) { return 1.5; }};
    options.progress = [](std::uint64_t) {};
    try {
        exchange::import_carla(bytes_in({data, size}), options, out);
    } catch (const world::Error&) {
        if (std::filesystem::exists(out))
            std::abort();
        return 0;
    }
    replay::TraceReader trace(out);
    for (std::uint64_t index = 1; index <= trace.ticks(); ++index)
        if (trace.tick(index).view.index() != index)
            std::abort();
    std::filesystem::remove(out);
    return 0;
}

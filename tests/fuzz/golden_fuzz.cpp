// libFuzzer at golden files: whatever is in one, it is read or refused in one line; what is read
// is written again as the same golden.
#include "replay/golden/golden.h"
#include "replay/golden/golden_difference.h"
#include "tests/fuzz/start.h"
#include "world/check.h"

using namespace reprise;

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    return test::start_fuzzing(argc, argv, [](const std::filesystem::path& folder) {
        for (const auto& entry :
             std::filesystem::directory_iterator(std::string(REPRISE_SOURCE) + "/scenarios"))
            if (entry.path().extension() == ".golden")
                test::write_seed(folder / entry.path().filename(), test::read_seed(entry.path()));
    });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    try {
        const replay::Golden golden = replay::parse_golden(text, "x.golden");
        const std::string written = replay::to_text(golden);
        if (replay::to_text(replay::parse_golden(written, "x.golden")) != written)
            std::abort();
        (void)replay::compare(golden, golden);
    } catch (const world::Error&) {
    }
    return 0;
}

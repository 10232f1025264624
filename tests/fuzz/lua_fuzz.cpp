// libFuzzer at what runs a stranger's scenario: no text may crash, hang or take more than a script
// may, neither when it is read nor in its first ticks, and equal runs are equal. Start: lua_fuzz
// --seeds FOLDER writes inputs; lua_fuzz FOLDER.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/scripting/hostile.h"
#include "tests/scripting/stage.h"
#include "world/check.h"

namespace {

using namespace reprise;

constexpr int ticks = 3;
constexpr std::size_t largest_seed = 4000;  // [bytes]

struct Played {
    std::vector<std::uint64_t> digests;
    std::string mistake;

    bool operator==(const Played&) const = default;
};

Played play(const std::string& source) {
    Played played;
    try {
        test::Stage stage(source);
        stage.play(ticks);
        played.digests = stage.digests;
    } catch (const world::Error& error) {
        played.mistake = error.what();
    }
    return played;
}

/// Its endless loops end soon, its texts are short: a budget takes seconds to use up when
/// sanitizers look on.
std::string shortened(std::string source) {
    const std::string endless = "while true do";
    for (auto at = source.find(endless); at != std::string::npos; at = source.find(endless))
        source.replace(at, endless.size(), "for k = 1, 9 do");
    for (auto at = source.find("0000"); at != std::string::npos; at = source.find("0000"))
        source.erase(at, 2);
    return source;
}

void write_seeds(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    for (const auto& entry : std::filesystem::directory_iterator(REPRISE_SCENARIOS))
        if (entry.path().extension() == ".lua")
            std::filesystem::copy_file(entry.path(),
                                       folder / entry.path().filename(),
                                       std::filesystem::copy_options::overwrite_existing);
    for (const auto& scripts : {test::hostile_loads(),
                                test::hostile_works(),
                                test::hostile_texts(),
                                test::hostile_asks()})
        for (const test::Hostile& script : scripts)
            if (const std::string source = script.source.made(); source.size() <= largest_seed)
                std::ofstream(folder / script.name, std::ios::binary) << shortened(source);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    if (*argc == 3 && std::string_view((*argv)[1]) == "--seeds") {
        write_seeds((*argv)[2]);
        std::exit(0);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string source(reinterpret_cast<const char*>(data), size);
    const Played first = play(source);
    // A second run of every text would halve the speed; of some it finds what differs.
    if (size % 8 == 0 && !(play(source) == first))
        std::abort();
    return 0;
}

#include <clocale>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

#include "tests/scripting/stage.h"
#include "world/check.h"
#include "world/digest.h"

/// play_scenario FILE TICKS: what it printed, how far it came, how it ended and one hash of all its
/// digests. Ends with 2 after a mistake of the script. Takes the environment's locale, as a
/// careless library would.
int main(int count, char** words) {
    if (count != 3)
        return 2;
    std::setlocale(LC_ALL, "");
    std::ifstream file(words[1], std::ios::binary);
    const std::string source{std::istreambuf_iterator<char>(file), {}};
    std::string end = "went on";
    std::optional<reprise::test::Stage> made;
    try {
        made.emplace(source);
    } catch (const reprise::world::Error& error) {
        std::printf("%s\n", error.what());
        return 2;
    }
    reprise::test::Stage& stage = *made;
    int code = 0;
    try {
        for (int tick = 0; tick < std::stoi(words[2]) && !stage.finished(); ++tick)
            stage.step();
        if (stage.finished())
            end = stage.reason();
    } catch (const reprise::world::Error& error) {
        end = error.what();
        code = 2;
    }
    for (const auto& event : stage.events)
        std::printf("%s\n", event.text.c_str());
    reprise::world::Hasher hasher;
    for (const std::uint64_t digest : stage.digests)
        hasher.add(digest);
    std::printf("%zu ticks, %016llx: %s\n",
                stage.digests.size(),
                static_cast<unsigned long long>(hasher.digest64()),
                end.c_str());
    return code;
}

#include "tests/towns/import/imports.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <unistd.h>
#include <utility>

#include "tests/traffic/stage.h"
#include "world/check.h"

namespace reprise::towns {

namespace fs = std::filesystem;

Imports::Imports()
    : folder_(fs::path(::testing::TempDir()) / ("reprise import, " + std::to_string(getpid()))) {
    fs::create_directories(folder_);
}

Imports::~Imports() {
    fs::remove_all(folder_);
}

std::string Imports::bytes(const fs::path& path) {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return std::move(all).str();
}

fs::path Imports::village() {
    return fs::path(REPRISE_SOURCE_DIR) / "tests/towns/village.osm";
}

fs::path Imports::empty(const std::string& name) const {
    fs::create_directory(folder_ / name);
    return folder_ / name;
}

fs::path Imports::write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
}

std::string Imports::message(const TownImport& wish) const {
    try {
        import_town(wish, empty("refused"));
    } catch (const world::Error& error) {
        return error.what();
    }
    return "no error";
}

void Imports::expect_same_bytes(const fs::path& map) const {
    const std::string name = map.stem().string();
    import_town({map, "", false, false}, empty(name + "1"));
    import_town({map, "", false, false}, empty(name + "2"));
    for (const std::string& ending :
         {name + ".net.xml", name + ".place.xml", std::string("import.txt")}) {
        const std::string first = bytes(folder_ / (name + "1") / ending);
        EXPECT_FALSE(first.empty()) << ending;
        EXPECT_EQ(first, bytes(folder_ / (name + "2") / ending)) << ending;
    }
}

void Imports::expect_traffic(const fs::path& map, int cars, int ticks) const {
    const fs::path made = empty(map.stem().string());
    import_town({map, "", false, false}, made);
    const test::Loaded loaded = test::load(made / (map.stem().string() + ".net.xml"));
    test::Stage stage(loaded, static_cast<std::uint32_t>(cars));
    double fastest = 0;
    for (int i = 0; i < ticks; ++i)
        for (const world::CarState& car : stage.step().traffic.cars)
            fastest = std::max(fastest, static_cast<double>(car.speed()));
    EXPECT_GT(fastest, 5) << map;
    EXPECT_GE(stage.draft().traffic.cars.size(), cars * 3U / 4) << map;
}

}  // namespace reprise::towns

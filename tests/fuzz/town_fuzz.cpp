// libFuzzer at what reads maps and networks in this process (netconvert is another's): whatever is
// in one, it becomes a town, or is refused in one line.
#include <fmt/format.h>

#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/start.h"
#include "tests/fuzz/xml_mutations.h"
#include "towns/maps/map_rings.h"
#include "towns/maps/map_source.h"
#include "towns/maps/opendrive.h"
#include "towns/maps/openstreetmap_check.h"
#include "towns/network/place.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/printable.h"

using namespace reprise;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

/// A network of one road, so that inputs stay small; and what lies beside it.
constexpr const char* street = R"(<net version="1.9" junctionCornerDetail="5">
<location netOffset="0.00,0.00" convBoundary="0.00,0.00,100.00,0.00" origBoundary="0,0,1,1" projParameter="!"/>
<edge id=":b_0" function="internal"><lane id=":b_0_0" index="0" speed="5" length="2.00" shape="100.00,-1.60 102.00,-1.60"/></edge>
<edge id="ab" from="a" to="b" priority="-1"><lane id="ab_0" index="0" allow="pedestrian" speed="13.89" length="100.00" width="2.00" shape="0.00,-5.00 100.00,-5.00"/>
<lane id="ab_1" index="1" disallow="pedestrian" speed="13.89" length="100.00" shape="0.00,-1.60 50.00,-1.70 100.00,-1.60"/></edge>
<edge id="bc" from="b" to="c" priority="-1"><lane id="bc_0" index="0" speed="13.89" length="98.00" shape="102.00,-1.60 200.00,-1.60"/></edge>
<tlLogic id="b" type="static" programID="0" offset="0"><phase duration="30" state="G"/><phase duration="3" state="y"/></tlLogic>
<junction id="a" type="dead_end" x="0.00" y="0.00" incLanes="" intLanes="" shape="0.00,0.00 0.00,-6.00"/>
<junction id="b" type="traffic_light" x="100.00" y="0.00" incLanes="ab_0 ab_1" intLanes=":b_0_0" shape="100.00,0.00 102.00,0.00 102.00,-6.00 100.00,-6.00"><request index="0" response="0" foes="0" cont="0"/></junction>
<junction id="c" type="dead_end" x="200.00" y="0.00" incLanes="bc_0" intLanes="" shape="200.00,0.00 200.00,-3.20"/>
<connection from="ab" to="bc" fromLane="1" toLane="0" via=":b_0_0" tl="b" linkIndex="0" dir="s" state="o"/>
<connection from=":b_0" to="bc" fromLane="0" toLane="0" dir="s" state="M"/>
</net>)";

void read(const std::filesystem::path& path) {
    static const std::filesystem::path nowhere = std::filesystem::temp_directory_path();
    const towns::MapSource source = towns::open_map(path, nowhere);
    switch (source.kind) {
        case towns::MapKind::openstreetmap:
            towns::check_openstreetmap(source.file, "map");
            (void)towns::read_rings(source.file, "map");
            break;
        case towns::MapKind::opendrive:
            (void)towns::read_opendrive(test::read_seed(path), "map");
            break;
        case towns::MapKind::network: {
            const towns::Network network = towns::load_network(path);
            (void)towns::read_town(network);
            break;
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    return test::start_fuzzing(argc, argv, [](const std::filesystem::path& folder) {
        const std::string source = REPRISE_SOURCE;
        test::write_seed(folder / "street.net.xml", street);
        test::write_seed(folder / "village.osm",
                         test::read_seed(source + "/tests/towns/village.osm"));
        test::write_seed(folder / "bridge.xodr",
                         test::read_seed(source + "/tests/maps/bridge.xodr"));
        test::write_seed(folder / "small.net.xml",
                         test::read_seed(source + "/tests/cli/crash/small.net.xml"));
        test::write_seed(folder / "town2.place.xml",
                         test::read_seed(source + "/scenarios/towns/town2/town2.place.xml"));
    });
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data,
                                               std::size_t size,
                                               std::size_t most,
                                               unsigned seed) {
    if (seed % 8 == 0)
        return LLVMFuzzerMutate(data, size, most);
    std::string xml = test::mutated_xml({reinterpret_cast<const char*>(data), size}, seed);
    xml.resize(std::min(xml.size(), most));
    std::copy(xml.begin(), xml.end(), data);
    return xml.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const test::MemoryFile file("map");
    try {
        const std::string text(reinterpret_cast<const char*>(data), size);
        if (text.find("<place") != std::string::npos)
            (void)towns::read_place(text, "x.place.xml");
        read(file.holding({data, size}));
    } catch (const world::Error& error) {
        // As every program shows it (cli/process/guard.cpp).
        if (world::printable_lines(error.what()).find('\x1b') != std::string::npos)
            std::abort();
    }
    return 0;
}

#include "towns/maps/plain_coordinates.h"

#include <array>
#include <fstream>
#include <memory>
#include <string_view>

#include <expat.h>
#include <fmt/format.h>

#include "world/check.h"
#include "world/printable.h"

namespace reprise::towns {

namespace {

using std::string_view;

bool is_coordinate(string_view name) {
    return name == "lat" || name == "lon" || name == "minlat" || name == "minlon" ||
           name == "maxlat" || name == "maxlon";
}

struct Search {
    XML_Parser parser = nullptr;
    std::string found;  ///< "12: node 7: ..."; empty as long as all are plain
};

void XMLCALL look(void* search, const XML_Char* element, const XML_Char** attributes) {
    auto& [parser, found] = *static_cast<Search*>(search);
    string_view id;
    for (const XML_Char** at = attributes; *at != nullptr; at += 2)
        if (string_view(at[0]) == "id")
            id = at[1];
    for (const XML_Char** at = attributes; *at != nullptr; at += 2) {
        if (!is_coordinate(at[0]) ||
            string_view(at[1]).find_first_not_of("0123456789.+-") == string_view::npos)
            continue;
        const std::string which = id.empty() ? element : fmt::format("{} {}", element, id);
        found = fmt::format("{}: {}: {}=\"{}\": digits with a sign and a point were expected",
                            XML_GetCurrentLineNumber(parser),
                            world::printable(which.substr(0, 60)),
                            at[0],
                            world::printable(string_view(at[1]).substr(0, 60)));
        XML_StopParser(parser, XML_FALSE);
        return;
    }
}

}  // namespace

void check_coordinates(const std::filesystem::path& map, const std::string& called) {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(nullptr), &XML_ParserFree);
    REPRISE_CHECK(parser != nullptr, std::string("no memory for a parser"));
    Search search{parser.get(), {}};
    XML_SetUserData(parser.get(), &search);
    XML_SetStartElementHandler(parser.get(), &look);

    std::ifstream file(map, std::ios::binary);
    std::array<char, 1 << 16> block;
    while (file) {
        file.read(block.data(), block.size());
        const XML_Status status =
            XML_Parse(parser.get(), block.data(), static_cast<int>(file.gcount()), file ? 0 : 1);
        if (!search.found.empty())
            throw world::Error(fmt::format("{}:{}", called, search.found));
        if (status == XML_STATUS_ERROR)
            return;  // whoever reads the map says what is wrong with its XML
    }
}

}  // namespace reprise::towns

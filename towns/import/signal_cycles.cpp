#include "towns/import/signal_cycles.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "towns/import/united_greens.h"
#include "towns/network/junction_links.h"
#include "towns/network/network_xml.h"

namespace reprise::towns {

namespace {

constexpr double longest_cycle = 120;  ///< [s] as guidelines for signals have it (RiLSA: 90, 120)

double duration(pugi::xml_node phase) {
    return number(phase.attribute("duration").value(), 0);
}

double cycle_of(pugi::xml_node program) {
    double cycle = 0;
    for (const pugi::xml_node phase : program.children("phase"))
        cycle += duration(phase);
    return cycle;
}

void shorten(pugi::xml_node program) {
    double greens = 0;
    for (const pugi::xml_node phase : program.children("phase"))
        greens += is_green(phase) ? duration(phase) : 0;
    const double others = cycle_of(program) - greens;
    const double share = std::max(0.0, longest_cycle - others) / std::max(greens, 1.0);
    for (pugi::xml_node phase : program.children("phase"))
        if (is_green(phase))
            phase.attribute("duration")
                .set_value(
                    fmt::format("{}", std::max(shortest_green, std::floor(duration(phase) * share)))
                        .c_str());
}

}  // namespace

ShortenedCycles shorten_cycles(std::string& network) {
    pugi::xml_document document;
    document.load_buffer(network.data(), network.size());
    const pugi::xml_node net = document.child("net");
    const JunctionLinks links(net);
    ShortenedCycles shortened;
    for (const pugi::xml_node program : net.children("tlLogic")) {
        const double cycle = cycle_of(program);
        if (cycle <= longest_cycle)
            continue;
        ++shortened.programs;
        shortened.longest = std::max(shortened.longest, cycle);
        unite_greens(program, net, links);
        if (cycle_of(program) > longest_cycle)
            shorten(program);
    }
    if (shortened.programs == 0)
        return shortened;
    std::ostringstream text;
    document.save(text, "    ");
    network = std::move(text).str();
    return shortened;
}

}  // namespace reprise::towns

#include "towns/maps/netconvert.h"

#include <algorithm>

#include <fmt/format.h>

#include "process/program.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::towns {

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t from = 0, to = 0; to != std::string::npos; from = to + 1) {
        to = text.find('\n', from);
        std::string line = text.substr(from, to - from);
        line.erase(0, line.find_first_not_of(" \t\r"));
        line.erase(line.find_last_not_of(" \t\r") + 1);
        if (!line.empty())
            lines.push_back(std::move(line));
    }
    return lines;
}

constexpr process::Limits limits{
    .memory = std::uint64_t{4} << 30, .seconds = 600, .file = std::uint64_t{2} << 30};

}  // namespace

std::filesystem::path sumo_folder() {
    return "/usr/share/sumo";
}

std::string reason_in(const std::string& said) {
    constexpr std::size_t most = 3;
    const std::vector<std::string> lines = lines_of(said);
    std::vector<std::string> errors;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!lines[i].starts_with("Error:"))
            continue;
        std::string error = lines[i].substr(6);
        error.erase(0, error.find_first_not_of(' '));
        // Where it is stands in the lines below.
        for (std::size_t more = i + 1; more < lines.size() && (lines[more].starts_with("In file") ||
                                                               lines[more].starts_with("At line"));
             ++more)
            if (lines[more].starts_with("At line"))
                error += " (" + lines[more].substr(3, lines[more].find_last_not_of('.') - 2) + ")";
        if (error == "No nodes loaded.")
            error = "No nodes loaded: it has no roads";
        if (error == "std::bad_alloc")
            error = "out of memory (std::bad_alloc): is it that large?";
        if (std::find(errors.begin(), errors.end(), error) == errors.end())
            errors.push_back(error);
    }
    if (errors.empty())
        return lines.empty() ? "it did not say why" : world::printable(lines.back());
    std::string reason;
    for (std::size_t i = 0; i < std::min(errors.size(), most); ++i)
        reason += (i == 0 ? "" : "; ") + errors[i];
    if (errors.size() > most)
        reason += fmt::format("; and {} more", errors.size() - most);
    return world::printable(reason);
}

int run_sumo_tool(const std::string& program,
                  std::vector<std::string> words,
                  const std::filesystem::path& scratch,
                  const std::string& map) {
    // Schemas are looked for in the internet, and OpenDRIVE imports fail without them.
    words.insert(words.end(), {"--xml-validation", "never"});
    // No variable of ours, which could change what it does.
    const process::ProgramResult result =
        process::run_program({.name = program,
                              .words = std::move(words),
                              .folder = scratch,
                              .variables = {"LC_ALL=C", "SUMO_HOME=" + sumo_folder().string()},
                              .only_these_variables = true,
                              .package = "sumo",
                              .limits = limits});
    if (!result.stopped.empty())
        throw world::Error(
            fmt::format("{}: {} {}: {}", map, program, result.stopped, reason_in(result.said)));
    if (result.code != 0)
        throw world::Error(
            fmt::format("{}: {} refuses it: {}", map, program, reason_in(result.said)));
    int warnings = 0;
    for (const std::string& line : lines_of(result.said))
        warnings += line.starts_with("Warning:") ? 1 : 0;
    return warnings;
}

std::vector<std::string> opendrive_words(const std::string& file) {
    const std::string types = (sumo_folder() / "data/typemap/opendriveNetconvert").string();
    return {
        "--opendrive-files",
        file,
        // The second adds sidewalks, which netconvert drops by itself.
        "--type-files",
        types + ".typ.xml," + types + "Pedestrians.typ.xml",
        "--crossings.guess",
        "--walkingareas",
        // Joins of two roads are no junctions, and what stands at them is no traffic light.
        "--geometry.remove",
        "--tls.discard-simple",
    };
}

std::vector<std::string> openstreetmap_words(const std::string& file, bool left_hand) {
    const std::string types = (sumo_folder() / "data/typemap/osmNetconvert").string();
    std::vector<std::string> words{
        "--osm-files",
        file,
        // Most roads have no maxspeed: 50 km/h in towns instead of the 80 and 100 of the first. The
        // third takes walkers off the roads: netconvert guesses no crossing of what they may walk
        // on, and footways that the map draws beside a road would have none.
        "--type-files",
        types + ".typ.xml," + types + "UrbanDe.typ.xml," + types + "Pedestrians.typ.xml",
        "--junctions.join",
        "--tls.guess-signals",
        "--tls.join",
        "--tls.discard-simple",
        "--keep-edges.by-vclass",
        "passenger,pedestrian",
        "--geometry.remove",
        // Nobody turns round in the middle of a city's junction.
        "--no-turnarounds.except-deadend",
        "--osm.sidewalks",
        "--crossings.guess",
        "--walkingareas",
    };
    if (left_hand)
        words.emplace_back("--lefthand");
    return words;
}

}  // namespace reprise::towns

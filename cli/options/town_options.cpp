#include "cli/options/town_options.h"

#include <CLI/CLI.hpp>

namespace reprise::cli {

namespace {

constexpr const char* town_help =
    "A town: its name, a folder that `town import` made, a SUMO network (.net.xml[.gz]), or a map "
    "(.xodr, .osm[.gz])";

void add_map_import(CLI::App& town, TownImportOptions& import) {
    CLI::App& command = *town.add_subcommand("import", "Make a town of a map");
    command
        .add_option(
            "map",
            import.source,
            "OpenDRIVE (.xodr), OpenStreetMap (.osm[.gz]) or a SUMO network (.net.xml[.gz])")
        ->required()
        ->type_name("MAP");
    command.add_option("-o,--output", import.directory, "The folder to make")
        ->required()
        ->type_name("DIR");
    command.add_option("--name", import.name, "Of the town (default: the map's)")
        ->type_name("NAME");
    command.add_flag("--lefthand",
                     import.left_hand,
                     "OpenStreetMap: traffic drives on the left (the map does not say so)");
    command
        .add_option("--sidewalks",
                    import.sidewalks,
                    "guess: add sidewalks and crossings where the map has none")
        ->type_name("guess")
        ->check(CLI::IsMember({"guess"}));
    command.add_flag("--force", import.force, "Replace DIR when it is a town already");
    command.footer(
        "Writes DIR/NAME.net.xml (the roads), DIR/NAME.place.xml (signs, signals, buildings, "
        "parks)\n"
        "and DIR/import.txt (what was done); needs netconvert, which Debian's package sumo has.\n"
        "Example: reprise town import harbour.osm.gz -o towns/harbour --lefthand");
}

void add_show(CLI::App& town, TownShowOptions& show) {
    CLI::App& command = *town.add_subcommand("show", "Draw a town as seen from above");
    command.add_option("town", show.town, town_help)->required()->type_name("TOWN");
    command.add_option("-o,--output", show.output, "Where the picture goes")
        ->required()
        ->type_name("MAP.png");
    command.add_option("--size", show.size, "Pixels of the longer side")
        ->capture_default_str()
        ->check(CLI::Range(200, 8000));
    command
        .add_option(
            "--region", show.region, "Only a part: south-west corner, width and height in metres")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X,Y,WIDTH,HEIGHT");
}

void add_check(CLI::App& town, TownCheckOptions& check) {
    CLI::App& command = *town.add_subcommand("check", "Say whether a town is fit to drive in");
    command.add_option("town", check.town, town_help)->required()->type_name("TOWN");
    command.add_flag("--json", check.json, "For programs");
    command.footer("Exit status: 0 all criteria hold, 1 one does not, 2 bad input.");
}

}  // namespace

void add_town_commands(CLI::App& app, TownOptions& town) {
    CLI::App& group = *app.add_subcommand("town", "Import, show or check a town");
    group.require_subcommand(1);
    add_map_import(group, town.import);
    add_show(group, town.show);
    add_check(group, town.check);
    for (CLI::App* command : group.get_subcommands([](const CLI::App*) { return true; }))
        command->callback([&town, command] { town.command = command->get_name(); });
}

}  // namespace reprise::cli

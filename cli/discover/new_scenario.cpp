#include "cli/discover/new_scenario.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "cli/town/towns.h"
#include "files/output_file.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

/// {0}: the name; {1}: the town.
constexpr std::string_view starter =
    R"lua(-- A van ahead of us stops. We see it, brake, and stop behind it.
--
--   reprise run {0}.lua                  runs it and records {0}.mcap
--   reprise run {0}.lua --set gap=40     the same with another parameter
--   reprise run {0}.lua --watch          again whenever this file is saved
--   reprise lint {0}.lua                 looks for mistakes
--   reprise list words                   what can be said here
return scenario '{0}' {{
    town = '{1}',            -- reprise list towns
    weather = 'clear_noon',  -- reprise list weathers
    duration = 30,           -- [s] the run's limit
    seed = 1,                -- decides everything that is drawn
    params = {{ gap = 20, speed_kmh = 30 }},
    run = function(p)
        -- Where: a lane that fits, in any town. One of `reprise list lanes {1}` does as well.
        local lane = pick_lane{{ length = 80 }}

        -- Who: places are of the rear axle, metres along the lane.
        local van = spawn{{ name = 'van', model = 'van', lane = lane, s = 10 + p.gap, speed_kmh = p.speed_kmh }}
        local ego = spawn{{ name = 'ego', model = 'sedan', lane = lane, s = 5, speed_kmh = p.speed_kmh }}

        -- What must hold in every tick, and what must have happened, lest it hold for nothing.
        check.never('a crash', function() return ego:collided() end)
        check.min('the gap [m]', function() return gap(ego, van) end, 1)
        check.eventually('we stop', function() return time() > 1 and ego:speed() < 0.1 end)

        -- Then what happens when.
        wait(1)
        van:set_speed(0)
        if not wait_until(function() return ego:speed() < 0.1 end, {{ timeout = 20 }}) then
            finish('we never stopped')
        end
        print(string.format('we stopped %.2f m behind the van', gap(ego, van)))
        wait(1)
    end,
}}
)lua";

/// The scenario's name in "first_steps", "tests/first_steps" or "first_steps.lua".
std::string name_of(const fs::path& path) {
    const std::string name = path.stem().string();
    const bool is_word =
        !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
            return std::isalnum(c) != 0 || c == '_';
        });
    const bool ends_well = path.extension().empty() || path.extension() == ".lua";
    if (!is_word || !ends_well)
        throw world::Error("new: a scenario's name is made of letters, digits and _, got '" +
                           path.filename().string() + "'");
    return name;
}

}  // namespace

int new_scenario(const NewOptions& options) {
    fs::path path = options.name;
    const std::string name = name_of(path);
    path.replace_extension(".lua");
    const std::string town = options.town.value_or("town1");
    load_town(town, path);  // there must be one
    if (town.find_first_of("'\\\n") != std::string::npos)
        throw world::Error("new: --town: no quotes in a town's name, got '" + town + "'");
    if (fs::exists(fs::symlink_status(path)))
        throw world::Error("new: '" + path.string() + "' is there already, and is left as it is");
    files::write_file(path, "the scenario", fmt::format(starter, name, town));
    say("wrote {}; try: reprise run {}\n", path.string(), path.string());
    say("in an editor that knows LuaLS: reprise list words --luals > {}\n",
        (path.parent_path() / "reprise.d.lua").string());
    return exit_good;
}

}  // namespace reprise::cli

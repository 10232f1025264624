#include "tests/cli/outputs/commands.h"

#include <gtest/gtest.h>

namespace reprise::test {

namespace fs = std::filesystem;

std::vector<std::string> WritingCommand::to(const std::string& out) const {
    std::vector<std::string> all = words;
    for (std::string& word : all)
        if (word == "OUT")
            word = out;
    return all;
}

const std::vector<WritingCommand>& writing_commands() {
    static const std::vector<WritingCommand> all{
        {"Run", {"run", "drive.lua", "-o", "OUT", "--for", "2"}},
        {"Strip", {"strip", "drive.mcap", "--level", "core", "-o", "OUT"}},
        {"Expand", {"expand", "core.mcap", "-o", "OUT"}},
        {"Slice", {"slice", "drive.mcap", "--ticks", "10..90", "-o", "OUT"}},
        {"Merge", {"merge", "early.mcap", "late.mcap", "-o", "OUT"}},
        {"Branch",
         {"branch", "drive.mcap", "--at", "80t", "--set", "pause=1", "--for", "5", "-o", "OUT"}},
        {"Recover", {"recover", "cut.mcap", "-o", "OUT"}},
        {"Import", {"import", "carla.log", "-o", "OUT"}},
        {"ExportFoxglove", {"export", "drive.mcap", "--to", "foxglove", "-o", "OUT"}},
        {"ExportJsonl", {"export", "drive.mcap", "--to", "jsonl", "-o", "OUT"}, false, true},
        {"ExportCsv", {"export", "drive.mcap", "--to", "csv", "-o", "OUT"}, true},
        {"Show", {"show", "drive.mcap", "-o", "OUT"}, false, true},
        {"Get", {"get", "drive.mcap", "scenario", "-o", "OUT"}, false, true},
        {"Render",
         {"render",
          "drive.mcap",
          "--every",
          "40",
          "--size",
          "64x48",
          "--camera",
          "depth",
          "-o",
          "OUT"},
         true},
        {"TownShow", {"town", "show", "town1", "--size", "200", "-o", "OUT"}},
        {"TownImport", {"town", "import", "village.osm", "-o", "OUT"}, true},
        {"Junit", {"test", "golden", "--junit", "OUT"}},
    };
    return all;
}

namespace {

void must(const std::vector<std::string>& words, const Folder& folder, int code = 0) {
    const Result result = reprise(words, folder.path());
    if (result.code != code)
        throw std::runtime_error(words[0] + ": " + result.out);
}

const Folder& inputs() {
    static const Folder folder;
    static const bool made = [] {
        write_file(folder / "drive.lua", R"(
            return scenario 'drive' { town = 'town1', duration = 6, cars = 5, seed = 3, params = { pause = 6 },
                run = function(p)
                    spawn{ name = 'ego', model = 'sedan' }
                    wait(p.pause)
                end })");
        must({"run", "drive.lua", "-o", "drive.mcap"}, folder);
        must({"strip", "drive.mcap", "--level", "core", "-o", "core.mcap"}, folder);
        must({"slice", "drive.mcap", "--ticks", "1..50", "-o", "early.mcap"}, folder);
        must({"slice", "drive.mcap", "--ticks", "51..120", "-o", "late.mcap"}, folder);
        const std::string whole = read_file(folder / "drive.mcap");
        write_file(folder / "cut.mcap", whole.substr(0, whole.size() * 9 / 10));
        const Result log = run_program(
            "python3",
            {source("tests/exchange/make_carla_log.py"), folder / "carla.log", "--seconds", "5"});
        if (log.code != 0)
            throw std::runtime_error(log.out);
        fs::copy(source("tests/towns/village.osm"), folder.path());
        fs::create_directory(folder / "golden");
        write_file(folder / "golden/short.lua",
                   "return scenario 'short' { town = 'town1', duration = 1, run = function() "
                   "spawn{ name = 'ego', model = 'sedan' } wait(0.5) end }");
        must({"accept", "golden/short.lua", "--because", "new"}, folder);
        return true;
    }();
    (void)made;
    return folder;
}

}  // namespace

void give_inputs(const Folder& folder) {
    fs::copy(inputs().path(), folder.path(), fs::copy_options::recursive);
}

}  // namespace reprise::test

#include "cli/dataset/check_dataset.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/dataset/dataset_index.h"
#include "cli/options/options.h"
#include "cli/pictures/made_again.h"
#include "cli/pictures/manifest.h"
#include "cli/process/guard.h"
#include "cli/process/temporary_folder.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// With all that is read of it. Throws world::Error.
Json read_whole_index(const fs::path& path) {
    Json index = read_index(path);
    const auto is = [&](const char* key, Json::value_t type) {
        return index.contains(key) && index[key].type() == type;
    };
    using Type = Json::value_t;
    if (is("complete", Type::boolean) && !index["complete"].get<bool>())
        throw world::Error(path.string() +
                           ": is not complete; the command that makes it goes on where it was");
    bool good = is("traces", Type::array) && is("options", Type::object) &&
                is("files", Type::array) && is("program", Type::object) &&
                is("complete", Type::boolean);
    for (std::size_t i = 0; good && i < index["traces"].size(); ++i)
        for (const char* key : {"path", "chain"}) {
            const Json& trace = index["traces"][i];
            good = good && trace.is_object() && trace.contains(key) && trace[key].is_string();
        }
    if (good)
        for (const auto& [name, value] : index["options"].items())
            good = good && value.is_string() && name.starts_with("--");
    if (!good)
        throw world::Error(path.string() + ": this is no index that reprise dataset wrote");
    return index;
}

/// Where the traces of an index are, in its order: those that were named, or where they were.
std::vector<std::string> traces_of(const DatasetOptions& options, const Json& index) {
    std::vector<std::string> found(index["traces"].size());
    std::vector<std::string> paths = options.traces;
    if (paths.empty())
        for (const Json& trace : index["traces"])
            paths.push_back(trace["path"].get<std::string>());
    for (const std::string& path : paths) {
        replay::TraceReader reader(path);
        const std::string chain = chain_text(reader);
        const auto& all = index["traces"];
        const auto one = std::find_if(
            all.begin(), all.end(), [&](const Json& trace) { return trace["chain"] == chain; });
        if (one == all.end())
            throw world::Error(
                fmt::format("{}: this is none of the traces of {}", path, options.check));
        found[static_cast<std::size_t>(one - all.begin())] = path;
    }
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i].empty())
            throw world::Error(fmt::format("{} is made of {} as well: name all of its traces",
                                           options.check,
                                           index["traces"][i]["path"].get<std::string>()));
    return found;
}

/// The same words as then, into another folder.
DatasetOptions options_again(const DatasetOptions& options,
                             const Json& index,
                             const TemporaryFolder& folder) {
    std::vector<std::string> words{"reprise", "dataset"};
    for (const std::string& trace : traces_of(options, index))
        words.push_back(trace);
    words.push_back("--output=" + (folder / "made").string());
    CommandLine line;
    parse_again({words, index, options.threads, options.check}, folder, line);
    line.dataset.quiet = true;
    return line.dataset;
}

/// Of an index, beside its files, its options and where its traces lie.
constexpr std::initializer_list<const char*> told_parts{
    "format", "portable", "weathers", "cameras", "rays", "split", "frames_of", "frames"};

}  // namespace

int check_dataset(const DatasetOptions& options,
                  const std::function<int(const DatasetOptions&)>& make) {
    const fs::path root = options.check;
    const fs::path path = root / "dataset.json";
    const Json index = read_whole_index(path);
    const FileList then = read_file_list(index["files"], path.string());
    const TemporaryFolder folder;
    if (const int code = make(options_again(options, index, folder)))
        return code;
    const Json again = read_index(folder / "made/dataset.json");
    return tell_made_again(options.check,
                           root,
                           then,
                           read_file_list(again["files"], options.check),
                           same_program(index),
                           untrue_part(index, again, path, told_parts));
}

}  // namespace reprise::cli

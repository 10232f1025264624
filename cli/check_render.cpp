#include "cli/check_render.h"

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/options/options.h"
#include "cli/pictures/made_again.h"
#include "cli/pictures/manifest.h"
#include "cli/process/guard.h"
#include "cli/process/temporary_folder.h"
#include "files/json_text.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// A manifest that somebody names; a folder or a film stands for its own.
fs::path named_manifest(const fs::path& named) {
    const bool stands_for_it = fs::is_directory(named) || !film_ending(named).empty();
    return stands_for_it ? manifest_of(named) : named;
}

/// Throws world::Error when it is none.
Json read_manifest(const fs::path& file) {
    const auto refuse = [&] {
        throw world::Error(file.string() + ": this is no manifest that reprise render wrote");
    };
    if (!std::ifstream(file).is_open() || fs::is_directory(file))
        throw world::Error(file.string() + ": cannot be read");
    Json json = Json::parse(files::json_text(file), nullptr, false);
    if (json.is_discarded() || !json.is_object() ||
        json.value("manifest", Json()) != manifest_version)
        refuse();
    // What is read of it, with its types.
    const auto is_text = [](const Json& in, const char* key) {
        return in.is_object() && in.contains(key) && in[key].is_string();
    };
    const auto has = [&](const char* key) { return json.contains(key); };
    if (!has("program") || !has("trace") || !is_text(json["trace"], "path") ||
        !is_text(json["trace"], "chain") || !has("options") || !json["options"].is_object() ||
        !has("files") || !json["files"].is_array())
        refuse();
    for (const auto& [name, value] : json["options"].items())
        if (!value.is_string() || !name.starts_with("--"))
            refuse();
    return json;
}

/// Where the same is made again: of the same name, as a film is known by its ending.
fs::path output_again(const Json& manifest, const TemporaryFolder& folder) {
    const Json& files = manifest["files"];
    const bool film = files.size() == 1 && files[0].contains("pictures_xxh3");
    return film ? folder / fs::path(files[0]["path"].get<std::string>()).filename()
                : folder / "made";
}

/// The same words as then, into another folder.
RenderOptions options_again(const RenderOptions& options,
                            const Json& manifest,
                            const fs::path& trace,
                            const TemporaryFolder& folder) {
    CommandLine line;
    parse_again({{"reprise",
                  "render",
                  trace.string(),
                  "--output=" + output_again(manifest, folder).string()},
                 manifest,
                 options.threads,
                 options.check},
                folder,
                line);
    line.render.quiet = true;
    return line.render;
}

}  // namespace

int check_render(const RenderOptions& options,
                 const std::function<int(const RenderOptions&)>& render) {
    const fs::path path = named_manifest(options.check);
    if (path != options.check && !fs::exists(path))
        throw world::Error(fmt::format("{}: there is no {}, which is written last: it is not whole",
                                       options.check,
                                       path.string()));
    const Json manifest = read_manifest(path);
    const FileList then = read_file_list(manifest["files"], path.string());
    const fs::path root = path.parent_path();
    const fs::path trace =
        options.trace.empty() ? manifest["trace"]["path"].get<std::string>() : options.trace;
    {
        replay::TraceReader reader(trace);
        const auto chain = manifest["trace"]["chain"].get<std::string>();
        if (chain_text(reader) != chain)
            throw world::Error(fmt::format("{}: this is not the trace of {}, whose chain is {}",
                                           trace.string(),
                                           options.check,
                                           chain));
    }
    const TemporaryFolder folder;
    if (const int code = render(options_again(options, manifest, trace, folder)))
        return code;
    const Json again = read_manifest(manifest_of(output_again(manifest, folder)));
    return tell_made_again(options.check,
                           root,
                           then,
                           read_file_list(again["files"], options.check),
                           same_program(manifest),
                           untrue_part(manifest, again, path, {"ticks", "weather", "sensors"}));
}

}  // namespace reprise::cli

#include "cli/check_render.h"

#include <fstream>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/options/options.h"
#include "cli/pictures/manifest.h"
#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "cli/process/temporary_folder.h"
#include "files/output_file.h"
#include "world/check.h"
#include "world/fingerprint.h"

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
    std::ifstream stream(file, std::ios::binary);
    if (!stream.is_open() || fs::is_directory(file))
        throw world::Error(file.string() + ": cannot be read");
    Json json = Json::parse(stream, nullptr, false);
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
    for (const Json& one : json["files"])
        if (!is_text(one, "path") || !is_text(one, "xxh3"))
            refuse();
    return json;
}

/// Of a file: its own bytes', and what is to come out again: the same, of a film its pictures'.
struct FileDigests {
    std::string file;
    std::string made;
};

std::map<std::string, FileDigests> digests(const Json& manifest) {
    std::map<std::string, FileDigests> all;
    for (const Json& file : manifest["files"]) {
        const auto whole = file["xxh3"].get<std::string>();
        all[file["path"].get<std::string>()] = {whole, file.value("pictures_xxh3", whole)};
    }
    return all;
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
    std::vector<std::string> words{
        "reprise", "render", trace.string(), "--output=" + output_again(manifest, folder).string()};
    for (const auto& [name, value] : manifest["options"].items())
        words.push_back(name + "=" + value.get<std::string>());
    if (manifest.contains("rig")) {
        const fs::path rig = folder / "rig.json";
        files::write_file(rig, "the rig", manifest["rig"].dump());
        words.push_back("--rig=" + rig.string());
    }
    if (options.threads > 0)
        words.push_back(fmt::format("--threads={}", options.threads));
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    CommandLine line;
    if (line.parse(static_cast<int>(pointers.size()), pointers.data()))
        throw world::Error(options.check + ": its options are none of this program's");
    line.render.quiet = true;
    return line.render;
}

bool same_program(const Json& manifest) {
    Json now;
    for (const auto& [key, value] : world::build_fingerprint())
        now[key] = value;
    return manifest["program"] == now;
}

/// What became of a file; nothing where it is as it was.
std::string trouble_with(const fs::path& folder,
                         const std::string& name,
                         const FileDigests& then,
                         const std::map<std::string, FileDigests>& now) {
    const auto made = now.find(name);
    if (made == now.end())
        return "was not made again";
    if (made->second.made != then.made)
        return "made again it has other bytes";
    if (!fs::exists(folder / name))
        return "is no longer there";
    return file_digest(folder / name) == then.file ? "" : "was changed since it was made";
}

}  // namespace

int check_render(const RenderOptions& options,
                 const std::function<int(const RenderOptions&)>& render) {
    const fs::path path = named_manifest(options.check);
    const Json manifest = read_manifest(path);
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
    const auto then = digests(manifest);
    const auto now = digests(read_manifest(manifest_of(output_again(manifest, folder))));
    std::size_t different = 0;
    const auto tell = [&](const std::string& name, const std::string& trouble) {
        if (!trouble.empty() && ++different == 1)
            say("{}: {}\n", (root / name).string(), trouble);
    };
    for (const auto& [name, digest] : then)
        tell(name, trouble_with(root, name, digest, now));
    for (const auto& [name, digest] : now)
        tell(name, then.contains(name) ? "" : "is made now, and was not then");
    if (different == 0) {
        say("{}: all {} files were made again, byte for byte\n", options.check, then.size());
        return exit_good;
    }
    say("{}: {} of {} files differ{}\n",
        options.check,
        different,
        then.size(),
        same_program(manifest) ? "" : "; another program made them, see reprise --version");
    return exit_differs;
}

}  // namespace reprise::cli

#include "cli/pictures/made_again.h"

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "files/output_file.h"
#include "world/check.h"
#include "world/fingerprint.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

/// What became of a file; nothing where it is as it was.
std::string trouble_with(const fs::path& root,
                         const std::string& name,
                         const FileDigests& then,
                         const FileList& now) {
    const auto made = now.find(name);
    if (made == now.end())
        return "was not made again";
    if (made->second.made != then.made)
        return "made again it has other bytes";
    if (!fs::exists(root / name))
        return "is no longer there";
    return file_digest(root / name) == then.file ? "" : "was changed since it was made";
}

/// A film's bytes are its codec's affair: its pictures are compared.
std::string all_of(const FileList& files) {
    if (files.size() != 1)
        return fmt::format("all {} files were", files.size());
    const FileDigests& only = files.begin()->second;
    return only.file == only.made ? "its only file was" : "its pictures were";
}

}  // namespace

void parse_again(const Recipe& recipe, const TemporaryFolder& folder, CommandLine& line) {
    std::vector<std::string> words = recipe.words;
    for (const auto& [name, value] : recipe.said["options"].items())
        words.push_back(name + "=" + value.get<std::string>());
    if (recipe.said.contains("rig")) {
        const std::filesystem::path rig = folder / "rig.json";
        files::write_file(rig, "the rig", recipe.said["rig"].dump());
        words.push_back("--rig=" + rig.string());
    }
    if (recipe.threads > 0)
        words.push_back(fmt::format("--threads={}", recipe.threads));
    std::vector<char*> pointers;
    for (std::string& word : words)
        pointers.push_back(word.data());
    if (line.parse(static_cast<int>(pointers.size()), pointers.data()))
        throw world::Error(recipe.what + ": its options are none of this program's");
}

bool same_program(const Json& manifest) {
    Json now;
    for (const auto& [key, value] : world::build_fingerprint())
        now[key] = value;
    return manifest["program"] == now;
}

std::string untrue_part(const Json& then,
                        const Json& now,
                        const fs::path& path,
                        std::initializer_list<const char*> parts) {
    if (!same_program(then))
        return "";
    for (const char* part : parts)
        if (then.value(part, Json()) != now.value(part, Json()))
            return fmt::format("{}: its '{}' is not what its options make", path.string(), part);
    return "";
}

int tell_made_again(const std::string& what,
                    const fs::path& root,
                    const FileList& then,
                    const FileList& now,
                    bool same_program,
                    const std::string& untrue) {
    std::size_t different = 0;
    const auto tell = [&](const std::string& name, const std::string& trouble) {
        if (!trouble.empty() && ++different == 1)
            say("{}: {}\n", (root / name).string(), trouble);
    };
    for (const auto& [name, digests] : then)
        tell(name, trouble_with(root, name, digests, now));
    for (const auto& [name, digests] : now)
        tell(name, then.contains(name) ? "" : "is made now, and was not then");
    if (!untrue.empty())
        say("{}\n", untrue);
    if (different == 0) {
        say("{}: {} made again, byte for byte\n", what, all_of(then));
        return untrue.empty() ? exit_good : exit_differs;
    }
    say("{}: {} of {} {}{}\n",
        what,
        different,
        world::count_of(then.size(), "file"),
        different == 1 ? "differs" : "differ",
        same_program ? "" : "; another program made them, see reprise --version");
    return exit_differs;
}

}  // namespace reprise::cli

#include "cli/external/serve_folder.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

fs::path file_in(const fs::path& folder, const std::string& name, const std::string& ending) {
    constexpr std::size_t longest = 200;
    const bool is_plain = std::all_of(name.begin(), name.end(), [](unsigned char letter) {
        return letter >= ' ' && letter != '/' && letter != '\\' && letter != 127;
    });
    if (!is_plain || name.size() <= ending.size() || name.size() > longest || name.front() == '.' ||
        !name.ends_with(ending))
        throw world::Error(
            fmt::format("'{}': expected the name of a file in the server's folder, such as my{}",
                        name,
                        ending));
    fs::path path = folder / name;
    // What a writer puts beside it until it is whole counts as well.
    for (const fs::path& one : {path, fs::path(path.string() + ".partial")}) {
        std::error_code ignored;
        const fs::file_status there = fs::symlink_status(one, ignored);
        if (fs::exists(there) && !fs::is_regular_file(there))
            throw world::Error(fmt::format(
                "'{}': is no plain file in the server's folder; links are not followed", name));
    }
    return path;
}

void refuse_links_to_towns(const fs::path& folder, const std::string& town) {
    std::error_code ignored;
    const auto refuse = [&](const fs::path& one) {
        if (fs::is_symlink(fs::symlink_status(one, ignored)))
            throw world::Error(fmt::format(
                "{}: is a link; clients of a server reach nothing outside of its folder",
                one.lexically_relative(folder).string()));
    };
    const fs::path towns = folder / "towns";
    refuse(towns);
    if (town.empty() || town.find('/') != std::string::npos)
        return;
    refuse(towns / town);
    for (const auto& entry : fs::directory_iterator(towns / town, ignored))
        refuse(entry);
}

std::string as_named_in(const fs::path& folder, std::string message) {
    std::error_code ignored;
    const auto goes_on_before = [&](std::size_t at) {
        const auto before = static_cast<unsigned char>(at == 0 ? ' ' : message[at - 1]);
        return std::isalnum(before) != 0 || before == '/' || before == '.' || before == '_' ||
               before == '-';
    };
    for (const fs::path& path : {fs::absolute(folder, ignored),
                                 fs::absolute(folder, ignored).lexically_normal(),
                                 fs::weakly_canonical(folder, ignored),
                                 folder}) {
        std::string root = path.string();
        if (root.empty())
            continue;
        if (root.back() != '/')
            root += '/';
        for (std::size_t at = 0; (at = message.find(root, at)) != std::string::npos;)
            if (goes_on_before(at))
                ++at;
            else
                message.erase(at, root.size());
    }
    return message;
}

}  // namespace reprise::cli

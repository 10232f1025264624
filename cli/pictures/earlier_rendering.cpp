#include "cli/pictures/earlier_rendering.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <system_error>

#include <nlohmann/json.hpp>

#include "cli/pictures/cameras.h"
#include "cli/pictures/manifest.h"
#include "files/json_text.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

EarlierRendering::EarlierRendering(const fs::path& output) {
    const fs::path manifest = manifest_of(output);
    std::error_code error;
    if (!film_ending(output).empty() || !fs::is_regular_file(manifest, error))
        return;
    const auto json = nlohmann::json::parse(files::json_text(manifest), nullptr, false);
    // It would be replaced, and is not ours.
    if (!json.is_object() || !json.contains("manifest"))
        throw world::Error(manifest.string() +
                           ": is there and no manifest that reprise render wrote; name another "
                           "folder for -o");
    if (json["manifest"] != manifest_version)
        return;
    for (const nlohmann::json& file : json.value("files", nlohmann::json::array()))
        if (file.is_object() && file.value("path", nlohmann::json()).is_string())
            files_.push_back(output / file["path"].get<std::string>());
    fs::remove(manifest);
}

std::vector<fs::path> EarlierRendering::left_beside(const WrittenFiles& files) const {
    std::set<fs::path> anew;
    for (const WrittenFile& file : files.all())
        anew.insert(file.path.lexically_normal());
    std::vector<fs::path> left;
    std::error_code error;
    std::copy_if(files_.begin(), files_.end(), std::back_inserter(left), [&](const fs::path& file) {
        return !anew.contains(file.lexically_normal()) && fs::is_regular_file(file, error);
    });
    return left;
}

}  // namespace reprise::cli

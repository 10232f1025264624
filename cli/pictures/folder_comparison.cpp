#include "cli/pictures/folder_comparison.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>

#include "cli/pictures/file_list.h"
#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "render/picture_difference.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

/// Files by the folder that they are in; manifests say what was asked for, not what was seen.
std::map<std::string, std::set<std::string>> files_by_folder(const fs::path& root) {
    std::map<std::string, std::set<std::string>> all;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        const fs::path path = entry.path().lexically_relative(root);
        const std::string name = path.string();
        if (entry.is_regular_file() && name != "manifest.json" && !name.ends_with(".manifest.json"))
            all[path.parent_path().string()].insert(path.filename().string());
    }
    return all;
}

/// What is to be said of one folder of files.
struct FolderDifference {
    std::size_t same = 0;
    std::size_t different = 0;
    std::size_t alone = 0;
    std::string first;  ///< file that differs or is alone, and where in it
    double squares = 0;
    std::size_t pictures = 0;
    double largest = 0;
    double peak = 0;

    void note(const std::string& where) {
        if (first.empty())
            first = where;
    }

    void compare(const std::string& name, const fs::path& expected, const fs::path& found) {
        if (file_digest(expected) == file_digest(found)) {
            ++same;
            return;
        }
        const auto apart = render::picture_difference(expected, found);
        ++different;
        if (!apart || apart->pixels == 0)  // no pictures, or the same in another packing
            return note(name);
        note(fmt::format("{} at x {} y {}", name, apart->x, apart->y));
        squares += apart->squares;
        largest = std::max(largest, apart->largest);
        peak = apart->peak;
        ++pictures;
    }

    std::string text() const {
        if (different + alone == 0)
            return world::count_of(same, "file, identical", "files, identical");
        std::string said = fmt::format("{}, {}",
                                       world::count_of(same + different + alone, "file"),
                                       world::count_of(different, "differs", "differ"));
        if (alone > 0)
            said += fmt::format(", {} in one of both only", alone);
        if (pictures > 0 && peak > 0)
            said +=
                fmt::format(", PSNR {:.2f} dB over these",
                            10 * std::log10(peak * peak * static_cast<double>(pictures) / squares));
        if (pictures > 0)
            said += fmt::format(", largest difference {:g}", largest);
        return said + "; first in " + first;
    }
};

}  // namespace

int compare_folders(const fs::path& expected, const fs::path& found) {
    const auto left = files_by_folder(expected);
    const auto right = files_by_folder(found);
    std::set<std::string> folders;
    for (const auto* side : {&left, &right})
        for (const auto& [folder, files] : *side)
            folders.insert(folder);
    if (folders.empty())
        throw world::Error(expected.string() + ": neither folder has files");
    bool same = true;
    for (const std::string& folder : folders) {
        const auto files_of = [&](const auto& side) {
            const auto there = side.find(folder);
            return there == side.end() ? std::set<std::string>() : there->second;
        };
        const std::set<std::string> here = files_of(left);
        const std::set<std::string> there = files_of(right);
        std::set<std::string> names = here;
        names.insert(there.begin(), there.end());
        FolderDifference difference;
        for (const std::string& name : names)
            if (here.contains(name) && there.contains(name)) {
                difference.compare(name, expected / folder / name, found / folder / name);
            } else {
                ++difference.alone;
                difference.note(name);
            }
        say("{}: {}\n", folder.empty() ? "." : folder, difference.text());
        same = same && difference.different + difference.alone == 0;
    }
    return same ? exit_good : exit_differs;
}

}  // namespace reprise::cli

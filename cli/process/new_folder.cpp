#include "cli/process/new_folder.h"

#include <system_error>
#include <vector>

#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

NewFolder::NewFolder(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> missing;  // the innermost first
    for (fs::path path = fs::absolute(folder); !fs::exists(path, error) && path.has_relative_path();
         path = path.parent_path())
        if (path.has_filename())
            missing.push_back(path);
    {
        const files::EndingHeld held;
        fs::create_directories(folder, error);
        for (const fs::path& path : missing)
            if (fs::is_directory(path))
                made_.emplace_back(path);
    }
    if (!fs::is_directory(folder))
        throw world::Error(folder.string() + ": cannot be made a folder" +
                           (error ? ": " + error.message() : ""));
}

NewFolder::~NewFolder() {
    std::error_code ignored;
    for (const Made& made : made_)
        fs::remove(made.path, ignored);  // takes none that has something in it
}

}  // namespace reprise::cli

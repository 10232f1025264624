#include "cli/town/town_folder.h"

#include <algorithm>

#include "process/copy.h"
#include "process/held_signals.h"
#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

namespace {

constexpr process::Limits import_limits{.memory = std::uint64_t{8} << 30, .seconds = 600};

/// Removes what was begun, unless it was finished.
class Partial {
  public:
    explicit Partial(const fs::path& path) : path_(path) {
        std::error_code error;
        // Left by an import that was interrupted: nothing else makes such a folder.
        if (fs::is_directory(path / "import.work", error))
            fs::remove_all(path);
        if (!fs::create_directory(path, error))
            throw world::Error(path.string() + ": cannot be made" +
                               (error ? ": " + error.message() : ": is there already"));
    }

    ~Partial() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }

    Partial(const Partial&) = delete;
    Partial& operator=(const Partial&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
};

/// Nothing but what an import writes.
bool is_imported_town(const fs::path& folder) {
    const auto is_ours = [](const fs::directory_entry& entry) {
        const std::string name = entry.path().filename().string();
        return name == "import.txt" || name.ends_with(".net.xml") || name.ends_with(".place.xml");
    };
    return fs::exists(folder / "import.txt") &&
           std::all_of(fs::directory_iterator(folder), fs::directory_iterator(), is_ours);
}

void require_free(const fs::path& folder, bool replace) {
    if (folder.empty())
        throw world::Error("-o: the name of a folder was expected");
    if (fs::is_symlink(folder))
        throw world::Error(folder.string() + ": is a symbolic link; name a folder itself");
    if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder)))
        return;
    if (!fs::is_directory(folder))
        throw world::Error(folder.string() + ": is there already, and is not a folder");
    if (!is_imported_town(folder))
        throw world::Error(folder.string() +
                           ": is there already, and is not a town that was imported");
    if (!replace)
        throw world::Error(folder.string() + ": is there already; --force replaces it");
}

}  // namespace

std::string make_town_folder(const towns::TownImport& wish, const fs::path& folder, bool replace) {
    // "towns/x/" names the folder x.
    const fs::path target = folder.has_filename() ? folder : folder.parent_path();
    try {
        require_free(target, replace);
        const process::HeldSignals held;  // until what was begun is whole, or gone again
        const Partial partial(target.string() + ".partial");
        // In a process of its own: whatever ends that, what it began is removed here.
        const std::string report =
            process::run_copy({.subject = wish.map.string(),
                               .work = [&] { return towns::import_town(wish, partial.path()); },
                               .limits = import_limits});
        fs::remove_all(target);
        fs::rename(partial.path(), target);
        return report;
    } catch (const fs::filesystem_error& error) {
        throw world::Error(error.path1().string() + ": " + error.code().message());
    }
}

}  // namespace reprise::cli

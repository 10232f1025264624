#include "files/output_place.h"

#include <cerrno>
#include <sys/resource.h>
#include <system_error>

#include <fmt/format.h>

#include "world/check.h"

namespace reprise::files {

namespace fs = std::filesystem;

namespace {

constexpr int most_links = 40;  ///< one behind the other, as Linux has it

/// Links in /proc lead to open descriptors, and what they read as is no path that one could write:
/// renaming over /dev/stdout, or over what a shell redirected it to, would hit the wrong thing.
bool is_descriptor(const fs::path& path) {
    std::error_code ignored;
    const fs::path folder = fs::weakly_canonical(fs::absolute(path).parent_path(), ignored);
    return folder.string().starts_with("/proc/");
}

[[noreturn]] void refuse(const fs::path& named, const std::string& what, const std::string& why) {
    throw world::Error(fmt::format("{}: cannot write {}: {}", named.string(), what, why));
}

}  // namespace

OutputPlace output_place(const fs::path& named) {
    fs::path path = named;
    std::error_code ignored;
    for (int links = 0; !is_descriptor(path) && fs::is_symlink(path, ignored); ++links) {
        if (links == most_links)
            throw world::Error(named.string() + ": its links lead in a circle");
        path = path.parent_path() / fs::read_symlink(path);  // an absolute target stands alone
    }
    if (is_descriptor(path))
        return {path, PlaceKind::stream};
    const fs::file_status status = fs::status(path, ignored);
    return {path,
            fs::is_directory(status)                             ? PlaceKind::folder
            : fs::exists(status) && !fs::is_regular_file(status) ? PlaceKind::stream
                                                                 : PlaceKind::file};
}

fs::path output_target(const fs::path& named, const std::string& what) {
    const OutputPlace place = output_place(named);
    if (place.kind == PlaceKind::folder)
        refuse(named, what, "this is a folder; name a file in it");
    if (place.kind == PlaceKind::stream)
        refuse(named, what, "this is not a plain file");
    const fs::path folder = place.path.has_parent_path() ? place.path.parent_path() : ".";
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
        refuse(named, what, "there is no folder " + folder.string());
    return place.path;
}

std::string write_error(int error) {
    rlimit limit{};
    if (error != EFBIG || getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return std::generic_category().message(error);
    return fmt::format("no file may be larger than {:.1f} kB here (ulimit -f)",
                       static_cast<double>(limit.rlim_cur) / 1e3);
}

}  // namespace reprise::files

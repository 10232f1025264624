#include "cli/process/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "reprise_XXXXXX").string();
    if (!error && mkdtemp(pattern.data()) == nullptr)
        error.assign(errno, std::generic_category());
    if (error)
        throw world::Error("cannot make a temporary folder (TMPDIR): " + error.message());
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace reprise::cli

#include "cli/process/helper_program.h"

#include <array>

#include "world/check.h"

namespace reprise::cli {

namespace fs = std::filesystem;

fs::path helper_program(const std::string& name) {
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    const std::array<fs::path, 2> places{here / name, here / "../libexec/reprise" / name};
    for (const fs::path& place : places)
        if (fs::exists(place))
            return place;
    throw world::Error("cannot start " + places[0].string() +
                       ": there is no such file; is the installation complete?");
}

}  // namespace reprise::cli

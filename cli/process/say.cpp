#include "cli/process/say.h"

#include <cerrno>

#include "files/output_place.h"
#include "world/check.h"

namespace reprise::cli {

void say_formatted(std::FILE* file, std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file) != text.size() && file == stdout)
        throw world::Error("cannot write to the standard output: " + files::write_error(errno));
}

}  // namespace reprise::cli

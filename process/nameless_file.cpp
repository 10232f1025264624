#include "process/nameless_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include "world/check.h"

namespace reprise::process {

NamelessFile::NamelessFile() : file_(std::tmpfile()) {
    if (!file_)
        throw world::Error(std::string("cannot make a temporary file: ") + std::strerror(errno));
    fcntl(descriptor(), F_SETFD, FD_CLOEXEC);
}

int NamelessFile::descriptor() const {
    return fileno(file_.get());
}

bool NamelessFile::write(const std::string& text) const {
    for (std::size_t from = 0; from < text.size();) {
        const ssize_t wrote = ::write(descriptor(), text.data() + from, text.size() - from);
        if (wrote <= 0)
            return false;
        from += static_cast<std::size_t>(wrote);
    }
    return true;
}

std::string NamelessFile::read(std::size_t most) const {
    const auto size =
        static_cast<std::size_t>(std::max<off_t>(lseek(descriptor(), 0, SEEK_END), 0));
    std::string text(std::min(most, size), '\0');
    for (std::size_t from = 0; from < text.size();) {
        const ssize_t got =
            pread(descriptor(), text.data() + from, text.size() - from, static_cast<off_t>(from));
        if (got <= 0) {
            text.resize(from);
            break;
        }
        from += static_cast<std::size_t>(got);
    }
    return text;
}

}  // namespace reprise::process

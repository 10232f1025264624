#include "replay/mcap/files.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

#include "world/check.h"

namespace reprise::replay {

namespace {

std::string reason(int error) {
    return std::generic_category().message(error);
}

}  // namespace

InputFile::InputFile(std::filesystem::path path, std::string kind)
    : path_(std::move(path)),
      kind_(std::move(kind)) {
    // O_NONBLOCK: a pipe must be refused, not waited for.
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0)
        throw world::Error(
            fmt::format("{}: cannot open the {}: {}", path_.string(), kind_, reason(errno)));

    struct stat status {};

    const bool known = ::fstat(descriptor_, &status) == 0;
    if (!known || !S_ISREG(status.st_mode)) {
        ::close(descriptor_);
        throw world::Error(
            fmt::format("{}: not a {}: this is {}",
                        path_.string(),
                        kind_,
                        known && S_ISDIR(status.st_mode) ? "a folder" : "not a plain file"));
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
    ::close(descriptor_);
}

void InputFile::read(std::uint64_t offset, std::span<std::uint8_t> out) const {
    while (!out.empty()) {
        const ssize_t got =
            ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            fail(offset, "cannot read the " + kind_ + ": " + reason(errno));
        if (got == 0)
            fail(offset, "the file became shorter while it was read");
        offset += static_cast<std::uint64_t>(got);
        out = out.subspan(static_cast<std::size_t>(got));
    }
}

mcap::Bytes InputFile::read(std::uint64_t offset, std::uint64_t size) const {
    REPRISE_CHECK(offset <= size_ && size <= size_ - offset,
                  fmt::format("{} bytes at {} of {}", size, offset, size_));
    mcap::Bytes bytes(size);
    read(offset, bytes);
    return bytes;
}

void InputFile::fail(std::uint64_t offset, const std::string& what) const {
    throw world::Error(fmt::format("{}: byte {}: {}", path_.string(), offset, what));
}

}  // namespace reprise::replay

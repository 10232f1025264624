#include "replay/mcap/files.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
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

void check_output(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (std::filesystem::is_directory(status))
        throw world::Error(fmt::format(
            "{}: cannot write the trace: this is a folder; name a file in it", path.string()));
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw world::Error(
            fmt::format("{}: cannot write the trace: this is not a plain file", path.string()));
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    if (!std::filesystem::is_directory(folder, ignored))
        throw world::Error(fmt::format(
            "{}: cannot write the trace: there is no folder {}", path.string(), folder.string()));
}

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

OutputFile::OutputFile(const std::filesystem::path& path)
    : path_(path),
      partial_(path.string() + ".partial") {
    check_output(path_);
    check_output(partial_);
    open();
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0)
        ::close(descriptor_);
}

void OutputFile::open() {
    descriptor_ = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (descriptor_ < 0)
        fail(errno);

    // Not truncated before it is locked; and it may have been another run's that has just given it
    // its final name.
    struct stat opened {};

    struct stat named {};

    const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    const bool same = ::fstat(descriptor_, &opened) == 0 && ::stat(partial_.c_str(), &named) == 0 &&
                      opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
    if (!locked || !same)
        throw world::Error(
            fmt::format("{}: cannot write the trace: another run is writing {}; name another file",
                        path_.string(),
                        partial_.string()));
    if (::ftruncate(descriptor_, 0) != 0)
        fail(errno);
}

void OutputFile::append(mcap::View bytes) {
    while (!bytes.empty()) {
        const ssize_t put = ::write(descriptor_, bytes.data(), bytes.size());
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            fail(errno);
        size_ += static_cast<std::uint64_t>(put);
        bytes = bytes.subspan(static_cast<std::size_t>(put));
    }
}

void OutputFile::finish() {
    if (::fdatasync(descriptor_) != 0 && errno != EINVAL)
        fail(errno);
    if (::rename(partial_.c_str(), path_.c_str()) != 0)
        fail(errno);
    // The bytes are on disk and named; nothing that close could say would change that.
    ::close(descriptor_);
    descriptor_ = -1;
}

void OutputFile::keep(std::uint64_t size) noexcept {
    // Best effort: a longer file only ends in a record that readers recognise as cut off.
    if (::ftruncate(descriptor_, static_cast<off_t>(size)) == 0)
        size_ = size;
}

void OutputFile::remove() noexcept {
    ::unlink(partial_.c_str());
}

void OutputFile::fail(int error) const {
    throw world::Error(
        fmt::format("{}: cannot write the trace: {}", path_.string(), reason(error)));
}

}  // namespace reprise::replay

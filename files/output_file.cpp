#include "files/output_file.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "files/output_place.h"
#include "world/check.h"

namespace reprise::files {

OutputFile::OutputFile(const std::filesystem::path& path,
                       std::string what,
                       Unfinished unfinished,
                       const std::string& ending)
    : named_(path),
      path_(output_target(path, what)),
      partial_(path_.string() + ending),
      what_(std::move(what)),
      unfinished_(unfinished) {
    // Of our own making, and no link of anybody else's.
    if (std::filesystem::is_symlink(partial_))
        throw world::Error(fmt::format("{}: cannot write {}: {} is a symbolic link",
                                       named_.string(),
                                       what_,
                                       partial_.string()));
    output_target(partial_, what_);
    open();
}

OutputFile::~OutputFile() {
    if (descriptor_ < 0)
        return;
    if (unfinished_ == Unfinished::remove)
        remove();
    ::close(descriptor_);
}

void OutputFile::open() {
    const EndingHeld held;
    descriptor_ =
        ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOFOLLOW, 0666);
    if (descriptor_ < 0)
        fail(errno);

    // Not truncated before it is locked; and it may have been another run's that has just given it
    // its final name.
    struct stat opened {};

    struct stat named {};

    const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    const bool same = ::fstat(descriptor_, &opened) == 0 && ::stat(partial_.c_str(), &named) == 0 &&
                      opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
    if (!locked || !same) {
        ::close(descriptor_);
        throw world::Error(
            fmt::format("{}: cannot write {}: another run is writing {}; name another file",
                        named_.string(),
                        what_,
                        partial_.string()));
    }
    if (unfinished_ == Unfinished::remove)
        note_.emplace(partial_);
    if (::ftruncate(descriptor_, 0) != 0)
        fail(errno);
}

void OutputFile::append(std::span<const std::uint8_t> bytes) {
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

void OutputFile::append(std::string_view text) {
    append(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void OutputFile::finish(bool on_disk) {
    if (on_disk && ::fdatasync(descriptor_) != 0 && errno != EINVAL)
        fail(errno);
    if (::rename(partial_.c_str(), path_.c_str()) != 0)
        fail(errno);
    // The bytes are on disk and named; nothing that close could say would change that.
    note_.reset();
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
    note_.reset();
}

void OutputFile::fail(int error) const {
    throw world::Error(
        fmt::format("{}: cannot write {}: {}", named_.string(), what_, write_error(error)));
}

void write_file(const std::filesystem::path& path,
                const std::string& what,
                std::span<const std::uint8_t> bytes) {
    OutputFile file(path, what);
    file.append(bytes);
    file.finish(false);
}

void write_file(const std::filesystem::path& path, const std::string& what, std::string_view text) {
    write_file(
        path, what, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace reprise::files

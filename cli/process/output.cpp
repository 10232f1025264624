#include "cli/process/output.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "files/output_place.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

constexpr std::size_t large = 1 << 18;

/// /dev/stdout and its kin: what is written there goes where we print, and not over it.
bool is_standard_output(const std::string& path) {
    struct stat ours {};

    struct stat its {};

    return fstat(STDOUT_FILENO, &ours) == 0 && stat(path.c_str(), &its) == 0 &&
           ours.st_dev == its.st_dev && ours.st_ino == its.st_ino;
}

}  // namespace

Output::Output(const std::string& path) : path_(path) {
    if (path.empty() || path == "-")
        return;
    if (files::output_place(path).kind != files::PlaceKind::stream) {
        file_ = std::make_unique<files::OutputFile>(path, "the output");
    } else if (!is_standard_output(path)) {
        stream_.reset(std::fopen(path.c_str(), "ae"));
        if (!stream_)
            fail(errno);
    }
}

void Output::fail(int error) const {
    throw world::Error(fmt::format("cannot write to {}: {}",
                                   stream_ || file_ ? path_ : "the standard output",
                                   files::write_error(error)));
}

void Output::flush_if_large() {
    if (text.size() >= large)
        flush();
}

void Output::flush() {
    std::FILE* const stream = stream_ ? stream_.get() : stdout;
    if (file_)
        file_->append(text);
    else if (std::fwrite(text.data(), 1, text.size(), stream) != text.size())
        fail(errno);
    text.clear();
}

void Output::finish() {
    flush();
    if (file_)
        file_->finish();
    else if (stream_ && std::fflush(stream_.get()) != 0)
        fail(errno);
}

void end_quietly_when_nobody_reads() {
    // Whoever started us may have switched the signal off, as Python does.
    std::signal(SIGPIPE, SIG_DFL);
}

void refuse_overwriting(const std::filesystem::path& input, const std::filesystem::path& output) {
    std::error_code ignored;
    if (std::filesystem::equivalent(input, output, ignored))
        throw world::Error(output.string() +
                           ": the output is the input; give it another name with -o");
}

}  // namespace reprise::cli

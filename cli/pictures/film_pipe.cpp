#include "cli/pictures/film_pipe.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/process/helper_program.h"
#include "cli/process/reproduce.h"
#include "process/limits.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

constexpr double moment = 5;  // [s] in which a program ends that has said its last

}  // namespace

FilmPipe::FilmPipe(const std::filesystem::path& path,
                   const std::string& ending,
                   int width,
                   int height,
                   double rate)
    : path_(path) {
    if (width % 2 != 0 || height % 2 != 0)
        throw world::Error(fmt::format("{}: a film's width and height are even numbers, not {}x{}",
                                       path.string(),
                                       width,
                                       height));
    // A signal that comes while the program opens the file waits until it is ours to remove.
    const files::EndingHeld held;
    file_.emplace(path, "the film", files::Unfinished::remove, ".partial" + ending);
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw world::Error(fmt::format("{}: no socket: {}", path.string(), std::strerror(errno)));
    socket_ = ends[0];
    program_.emplace(fmt::format("exec {} {} {} {} {} {}",
                                 shell_path(helper_program("reprise-film")),
                                 shell_path(file_->partial()),
                                 ending,
                                 width,
                                 height,
                                 decimal(rate)),
                     ends[1],
                     std::string(film_variable) + "=%d");
    ::close(ends[1]);
    const std::string said = hear();
    if (said != film_begun)
        fail(said);
}

FilmPipe::~FilmPipe() {
    if (socket_ >= 0)
        ::close(socket_);
}

/// A line; what there is of one when the program ends.
std::string FilmPipe::hear() {
    std::string said;
    char letter = 0;
    while (!said.ends_with('\n')) {
        const ssize_t got = ::recv(socket_, &letter, 1, 0);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        said += letter;
    }
    return said;
}

void FilmPipe::add(std::span<const std::uint8_t> rgb) {
    while (!rgb.empty()) {
        const ssize_t put = ::send(socket_, rgb.data(), rgb.size(), MSG_NOSIGNAL);
        if (put < 0 && errno == EINTR)
            continue;
        if (put < 0)
            fail(hear());
        rgb = rgb.subspan(static_cast<std::size_t>(put));
    }
}

void FilmPipe::finish() {
    ::shutdown(socket_, SHUT_WR);
    const std::string said = hear();
    if (said != film_whole)
        fail(said);
    file_->finish(false);
}

void FilmPipe::fail(const std::string& said) {
    std::string why = said.substr(0, said.find('\n'));
    if (why.empty()) {
        const auto ended = program_->wait(moment);
        why = !ended               ? "reprise-film says nothing"
              : ended->signal != 0 ? "reprise-film " + process::reason(ended->signal, {})
                                   : fmt::format("reprise-film ended with {}", ended->code);
    }
    throw world::Error(fmt::format("{}: cannot write the film: {}", path_.string(), why));
}

}  // namespace reprise::cli

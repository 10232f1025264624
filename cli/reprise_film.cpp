// `reprise-film`: turns pictures that come through a socket into a film. Started by `reprise
// render`, which owns the file; a program of its own, because FFmpeg brings a hundred libraries
// along.
//   reprise-film FILE ENDING WIDTH HEIGHT RATE
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <sys/socket.h>
#include <vector>

#include "cli/pictures/film_pipe.h"
#include "cli/process/guard.h"
#include "render/film/film_writer.h"
#include "world/check.h"

namespace {

using namespace reprise;

void say_back(int socket, const std::string& text) {
    // Nobody hears it any more when who asked has ended: then we end as well.
    [[maybe_unused]] const auto sent = ::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
}

/// A whole picture; false when there are no more.
bool next_picture(int socket, std::vector<std::uint8_t>& rgb) {
    for (std::size_t have = 0; have < rgb.size();) {
        const ssize_t got = ::recv(socket, rgb.data() + have, rgb.size() - have, MSG_WAITALL);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return false;
        have += static_cast<std::size_t>(got);
    }
    return true;
}

void make_film(int socket, char** words) {
    // FFmpeg and OpenCV grumble there; who started us hears what matters.
    if (std::freopen("/dev/null", "w", stderr) == nullptr)
        throw world::Error("/dev/null cannot be written");
    render::FilmFormat format;
    format.ending = words[2];
    format.width = std::atoi(words[3]);
    format.height = std::atoi(words[4]);
    format.rate = std::strtod(words[5], nullptr);
    render::FilmWriter film(words[1], format);
    say_back(socket, cli::film_begun);
    std::vector<std::uint8_t> rgb(static_cast<std::size_t>(format.width) *
                                  static_cast<std::size_t>(format.height) * 3);
    while (next_picture(socket, rgb))
        film.add(rgb);
    film.finish();
    say_back(socket, cli::film_whole);
}

}  // namespace

int main(int argc, char** argv) {
    return cli::guarded(cli::command_text(argc, argv), [&]() -> int {
        const char* socket = std::getenv(cli::film_variable);
        constexpr int all_words = 6;
        if (argc != all_words || socket == nullptr)
            throw world::Error("reprise-film is started by reprise render -o FILM");
        try {
            make_film(std::atoi(socket), argv);
        } catch (const std::exception& error) {
            say_back(std::atoi(socket), std::string(error.what()) + "\n");
            return cli::exit_bad_input;
        }
        return cli::exit_good;
    });
}

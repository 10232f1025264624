#include "cli/external/serve.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <list>
#include <poll.h>
#include <sys/socket.h>

#include <fmt/format.h>

#include "cli/external/serve_folder.h"
#include "cli/external/serve_places.h"
#include "cli/external/serve_session.h"
#include "cli/fingerprint/self_test.h"
#include "cli/process/guard.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "process/held_signals.h"
#include "process/offshoot.h"
#include "remote/listener.h"
#include "world/check.h"
#include "world/printable.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

constexpr std::size_t largest_word = 2 << 20;    // [bytes] of a client
constexpr std::string_view open_socket = "fd:";  // a socket that is open and connected
constexpr const char* loopback = "127.0.0.1";
constexpr std::size_t most_strangers = 16;  // at once, who have not shown yet that they may come in
constexpr double greeting = 10;             // [s] for a client's first word
constexpr double patience_at_end = 6;       // [s] for sessions to close their traces

/// As ssh does with keys. What is no file, such as a pipe of the shell's, has no mode that counts.
void refuse_if_others_may(const std::string& path) {
    namespace fs = std::filesystem;
    constexpr auto others = fs::perms::group_all | fs::perms::others_all;
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_regular_file(status) && (status.permissions() & others) != fs::perms::none)
        throw world::Error(
            fmt::format("--token-file {}: other users may open it (mode {:03o}): chmod 600 {}",
                        world::printable(path),
                        static_cast<unsigned>(status.permissions() & fs::perms::all),
                        shell_path(path)));
}

std::string read_token(const std::string& path) {
    constexpr std::size_t shortest = 16;
    if (path.empty())
        return "";
    refuse_if_others_may(path);
    std::ifstream file(path);
    if (!file)
        throw world::Error(fmt::format(
            "--token-file {}: cannot be read: {}", world::printable(path), std::strerror(errno)));
    std::string token;
    std::getline(file, token);
    if (token.size() < shortest)
        throw world::Error(
            fmt::format("--token-file {}: expected a first line of at least {} characters",
                        world::printable(path),
                        shortest));
    return token;
}

/// The descriptor that fd:N names, when it does.
std::optional<int> open_descriptor(const std::string& text) {
    if (!text.starts_with(open_socket))
        return std::nullopt;
    int descriptor = -1;
    const char* const begin = text.data() + open_socket.size();
    const char* const end = text.data() + text.size();
    sockaddr_storage peer{};
    socklen_t size = sizeof(peer);
    if (std::from_chars(begin, end, descriptor).ptr != end || descriptor < 3 ||
        getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size) != 0)
        throw world::Error("--socket " + world::printable(text) +
                           ": expected the number of a connected socket");
    return descriptor;
}

class Server {
  public:
    Server(const ServeOptions& options, const process::HeldSignals& signals)
        : options_(options),
          signals_(&signals),
          token_(read_token(options.token_file)),
          places_(options.episodes) {
        if (options_.port)
            listener_.emplace(options_.listen.empty() ? loopback : options_.listen, *options_.port);
        else
            listener_.emplace(std::filesystem::path(options_.socket), "--socket ");
        if (!options_.town.empty())
            town_ = make_ready(options_.town, options_.folder);
    }

    std::string place() const {
        return options_.port ? fmt::format("{}:{}",
                                           options_.listen.empty() ? loopback : options_.listen,
                                           listener_->port())
                             : options_.socket;
    }

    /// Until a signal ends us. Returns it.
    int run() {
        for (;;) {
            std::array<pollfd, 2> all{pollfd{listener_->descriptor(), POLLIN, 0},
                                      pollfd{signals_->descriptor(), POLLIN, 0}};
            poll(all.data(), all.size(), -1);
            if (all[1].revents != 0) {
                const int signal = signals_->take();
                see_off();
                if (signal != 0 && signal != SIGCHLD)
                    return signal;
            }
            if (all[0].revents != 0)
                welcome();
        }
    }

    /// All episodes end, with whole traces where they can.
    void end() {
        for (const Guest& guest : sessions_)
            guest.session.ask_to_end();
        double left = patience_at_end;
        for (Guest& guest : sessions_)
            if (!guest.session.wait(left))
                left = 0;
        sessions_.clear();
    }

  private:
    /// The session of one who came, in the order in which they did.
    struct Guest {
        std::uint64_t number;
        process::Offshoot session;
    };

    /// Those that have ended.
    void see_off() {
        sessions_.remove_if([&](Guest& one) {
            const bool has_ended = one.session.wait(0).has_value();
            if (has_ended)
                places_.free(one.number);
            return has_ended;
        });
    }

    /// Who says nothing is waited for, but keeps nobody out: where too many do, the one who has
    /// been silent for longest has to go.
    void make_room() {
        const auto is_stranger = [&](const Guest& one) { return !places_.has(one.number); };
        const auto strangers = std::count_if(sessions_.begin(), sessions_.end(), is_stranger);
        if (static_cast<std::size_t>(strangers) >= most_strangers)
            sessions_.erase(std::find_if(sessions_.begin(), sessions_.end(), is_stranger));
    }

    /// In the session of a client whose first word is right. Empty: it may stay.
    std::string why_not(std::uint64_t number, bool is_another_users) {
        if (is_another_users)
            return "this server is another user's: it wants a --token-file";
        if (!places_.take(number))
            return world::count_of(options_.episodes, "client is", "clients are") +
                   " served already (--episodes)";
        return "";
    }

    void welcome() {
        std::optional<remote::FrameChannel> client;
        try {
            client.emplace(listener_->accept_one({1.0}), largest_word);
        } catch (const remote::ChannelFault&) {
            return;  // it went as soon as it came
        }
        const bool is_another_users =
            options_.port && token_.empty() && !remote::is_of_our_user(client->descriptor());
        make_room();
        try {
            const std::uint64_t number = ++came_;
            const auto serve_it = [&] {
                listener_->let_go();
                Session(options_, token_, std::move(town_), std::move(*client), *signals_)
                    .run(greeting, [&] { return why_not(number, is_another_users); });
                return exit_good;
            };
            sessions_.push_back({number, process::Offshoot(serve_it, true)});
        } catch (const world::Error& error) {
            say(stderr, "reprise: {}\n", error.what());  // the client is hung up on
        }
    }

    ServeOptions options_;
    const process::HeldSignals* signals_;
    std::string token_;
    std::optional<remote::Listener> listener_;
    std::unique_ptr<ReadyTown> town_;
    Places places_;
    std::uint64_t came_ = 0;  ///< so many
    std::list<Guest> sessions_;
};

}  // namespace

int serve(const ServeOptions& asked) {
    self_test();
    ServeOptions options = asked;
    if (options.socket.empty())
        options.socket = "reprise.sock";
    refuse_links_to_towns(options.folder);
    const process::HeldSignals signals;
    if (const auto descriptor = open_descriptor(options.socket)) {
        auto town = options.town.empty() ? nullptr : make_ready(options.town, options.folder);
        Session(options,
                read_token(options.token_file),
                std::move(town),
                {*descriptor, largest_word},
                signals)
            .run(std::nullopt, [] { return ""; });
        return exit_good;
    }
    Server server(options, signals);
    say("serving at {}\n", server.place());
    std::fflush(stdout);
    const int signal = server.run();
    server.end();
    return exit_stopped + signal;
}

}  // namespace reprise::cli

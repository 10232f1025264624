#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace reprise::cli {

struct ServeOptions {
    std::string socket;                 ///< a path, or fd:N: a connected socket of one client
    std::optional<std::uint16_t> port;  ///< TCP; 0: one that is free
    std::string listen;                 ///< another IPv4 address than this machine's own
    std::string token_file;
    std::string folder = ".";  ///< scenarios, towns and traces of clients
    unsigned episodes = 64;    ///< at once, which is clients
    std::string town;          ///< made ready before the first client comes
    double memory_gb = 4;      ///< [GB] of address space of an episode
};

void add_serve(CLI::App& app, ServeOptions& serve);

}  // namespace reprise::cli

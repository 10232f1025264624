#include "remote/connection.h"

#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <optional>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <netdb.h>

#include "world/check.h"

namespace reprise::remote {

namespace {

int connect_to_path(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof(address.sun_path))
        throw world::Error(path + ": longer than a socket's path may be");
    std::memcpy(address.sun_path, path.data(), path.size());
    const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
        const int reason = errno;
        close(descriptor);
        throw world::Error(path + ": nobody is there: " + std::strerror(reason));
    }
    return descriptor;
}

/// "HOST:PORT", where it is that.
std::optional<std::pair<std::string, std::string>> host_and_port(const std::string& address) {
    const auto colon = address.rfind(':');
    if (colon == std::string::npos || colon + 1 == address.size() ||
        address.find('/') != std::string::npos ||
        address.find_first_not_of("0123456789", colon + 1) != std::string::npos)
        return std::nullopt;
    return std::pair(address.substr(0, colon), address.substr(colon + 1));
}

int connect_to_port(const std::string& host, const std::string& port) {
    addrinfo wanted{};
    wanted.ai_family = AF_INET;
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (const int fault = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found); fault != 0)
        throw world::Error(
            fmt::format("{}:{}: no such place: {}", host, port, gai_strerror(fault)));
    const int descriptor = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool connected = connect(descriptor, found->ai_addr, found->ai_addrlen) == 0;
    const int reason = errno;
    freeaddrinfo(found);
    if (!connected) {
        close(descriptor);
        throw world::Error(
            fmt::format("{}:{}: nobody is there: {}", host, port, std::strerror(reason)));
    }
    const int yes = 1;  // a tick is one small message each way: it shall not wait for more
    setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
    return descriptor;
}

}  // namespace

int open_connection(const std::string& address) {
    const auto place = host_and_port(address);
    return place ? connect_to_port(place->first, place->second) : connect_to_path(address);
}

}  // namespace reprise::remote

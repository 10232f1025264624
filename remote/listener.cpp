#include "remote/listener.h"

#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sstream>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "world/check.h"
#include "world/printable.h"

namespace reprise::remote {

namespace {

namespace fs = std::filesystem;
constexpr int waiting_at_once = 64;

/// Whether a socket file is one that nobody listens at: its program was killed.
bool is_left_behind(const sockaddr_un& address) {
    struct stat there {};

    if (lstat(static_cast<const char*>(address.sun_path), &there) != 0 || !S_ISSOCK(there.st_mode))
        return false;
    // Without waiting: whose queue is full listens.
    const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const bool refused =
        connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 &&
        errno == ECONNREFUSED;
    close(probe);
    return refused;
}

/// For people: what keeps us from making a socket at a path.
std::string what_is_there(const sockaddr_un& address) {
    struct stat there {};

    if (lstat(static_cast<const char*>(address.sun_path), &there) != 0)
        return std::strerror(EADDRINUSE);
    if (S_ISSOCK(there.st_mode))
        return "another program listens there";
    const char* const what = S_ISREG(there.st_mode)   ? "a file"
                             : S_ISDIR(there.st_mode) ? "a folder"
                             : S_ISLNK(there.st_mode) ? "a link"
                                                      : "something else than a socket";
    return fmt::format("{} is there, and stays: expected a path where nothing is yet", what);
}

int bind_owners_only(int descriptor, const sockaddr_un& address) {
    const mode_t before = umask(0177);
    int reason = 0;
    if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
        reason = errno;
    umask(before);
    return reason;
}

/// As /proc/net/tcp writes it: bytes of the address as they lie in memory, port in host order.
std::string as_the_kernel_writes(const sockaddr_in& address) {
    return fmt::format("{:08X}:{:04X}", address.sin_addr.s_addr, ntohs(address.sin_port));
}

}  // namespace

Listener::Listener(fs::path path, const std::string& who) : path_(std::move(path)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path_.native().size() >= sizeof(address.sun_path))
        throw world::Error(fmt::format("{}{}: a socket's path has at most {} bytes",
                                       who,
                                       world::printable(path_.string()),
                                       sizeof(address.sun_path) - 1));
    std::memcpy(address.sun_path, path_.c_str(), path_.native().size());
    descriptor_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    int reason = bind_owners_only(descriptor_, address);
    if (reason == EADDRINUSE && is_left_behind(address)) {
        std::error_code ignored;
        fs::remove(path_, ignored);
        reason = bind_owners_only(descriptor_, address);
    }
    if (reason == 0 && listen(descriptor_, waiting_at_once) != 0)
        reason = errno;
    if (reason != 0) {
        close(descriptor_);
        throw world::Error(
            fmt::format("{}{}: cannot listen there: {}",
                        who,
                        world::printable(path_.string()),
                        reason == EADDRINUSE ? what_is_there(address) : std::strerror(reason)));
    }
}

Listener::Listener(const std::string& address, std::uint16_t port) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    if (inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
        throw world::Error(
            fmt::format("--listen {}: expected an IPv4 address in digits, such as 192.168.1.5",
                        world::printable(address)));
    descriptor_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const int yes = 1;
    setsockopt(descriptor_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    socklen_t size = sizeof(place);
    if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&place), size) != 0 ||
        listen(descriptor_, waiting_at_once) != 0 ||
        getsockname(descriptor_, reinterpret_cast<sockaddr*>(&place), &size) != 0) {
        const int reason = errno;
        close(descriptor_);
        throw world::Error(
            fmt::format("{}:{}: cannot listen there: {}", address, port, std::strerror(reason)));
    }
    port_ = ntohs(place.sin_port);
}

Listener::~Listener() {
    if (descriptor_ >= 0)
        close(descriptor_);
    std::error_code ignored;
    if (!path_.empty())
        fs::remove(path_, ignored);
}

int Listener::accept_one(const Patience& patience) const {
    wait_for_input(descriptor_, patience);
    const int client = accept4(descriptor_, nullptr, nullptr, SOCK_CLOEXEC);
    if (client < 0)
        throw ChannelFault(std::strerror(errno));
    if (path_.empty()) {
        const int yes = 1;  // a tick is one small message each way: it shall not wait for more
        setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof(yes));
        setsockopt(client, SOL_SOCKET, SO_KEEPALIVE, &yes, sizeof(yes));
    }
    return client;
}

void Listener::let_go() {
    close(descriptor_);
    descriptor_ = -1;
    path_.clear();
}

bool is_of_our_user(int descriptor) {
    sockaddr_in here{};
    sockaddr_in there{};
    socklen_t size = sizeof(here);
    if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&here), &size) != 0 ||
        here.sin_family != AF_INET ||
        getpeername(descriptor, reinterpret_cast<sockaddr*>(&there), &size) != 0)
        return false;
    // The other end is a socket of this machine as well, with an owner.
    const std::string its_own = as_the_kernel_writes(there);
    const std::string its_other = as_the_kernel_writes(here);
    std::ifstream table("/proc/net/tcp");
    for (std::string line; std::getline(table, line);) {
        std::istringstream words(line);
        std::string number, own, other, state, queues, timer, retries;
        uid_t user = 0;
        words >> number >> own >> other >> state >> queues >> timer >> retries >> user;
        if (words && own == its_own && other == its_other)
            return user == geteuid();
    }
    return false;
}

}  // namespace reprise::remote

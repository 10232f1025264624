#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "remote/frame_channel.h"

namespace reprise::remote {

/// Where others come to us: a socket in the file system that only we can open, gone from its folder
/// with us, or a TCP port.
class Listener {
  public:
    /// A Unix domain socket. What a program that was killed left at the path is taken away, and
    /// nothing else. `who` begins messages, before the path: "--driver socket:". Throws
    /// world::Error.
    Listener(std::filesystem::path path, const std::string& who);

    /// TCP, at a numeric IPv4 address. `port` 0: one that is free. Throws world::Error.
    Listener(const std::string& address, std::uint16_t port);

    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    /// The next one who comes, as a connected socket. Throws ChannelFault when none did in time.
    int accept_one(const Patience& patience) const;

    int descriptor() const { return descriptor_; }

    std::uint16_t port() const { return port_; }  ///< of TCP

    /// In a copy of the process that opened it: lets go, and leaves the file to that one.
    void let_go();

  private:
    std::filesystem::path path_;  ///< empty: TCP
    std::uint16_t port_ = 0;
    int descriptor_ = -1;
};

/// Whether the program at the other end of a connection within this machine runs under our user;
/// a Unix domain socket and an address of another machine are not asked about, and false.
bool is_of_our_user(int descriptor);

}  // namespace reprise::remote

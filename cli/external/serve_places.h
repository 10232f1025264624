#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reprise::cli {

/// The places of those clients that a server serves: a session takes one when its client has shown
/// that it may come in, and not before; who says nothing holds none. In memory that the server
/// shares with the sessions, its copies.
class Places {
  public:
    /// Throws world::Error where there is no memory.
    explicit Places(std::size_t most);
    ~Places();
    Places(const Places&) = delete;
    Places& operator=(const Places&) = delete;

    /// In a session. `who`: its number, not 0. False: all are taken.
    bool take(std::uint64_t who);

    bool has(std::uint64_t who) const;

    /// By the server, behind the end of the session, however it ended.
    void free(std::uint64_t who);

  private:
    std::span<std::atomic<std::uint64_t>> all_;  ///< by whom each is taken; 0: by nobody
};

}  // namespace reprise::cli

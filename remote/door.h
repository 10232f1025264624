#pragma once

#include <string>

#include "remote/listener.h"

namespace reprise::remote {

/// Where the driver of one vehicle comes in that runs already: the first who comes, if a program of
/// our user's. Everybody else is told in one line why not.
class Door {
  public:
    /// A socket that only we can open. Throws world::Error.
    Door(const std::filesystem::path& path, std::string actor);

    /// TCP at 127.0.0.1; port 0: one that is free. Throws world::Error.
    Door(std::uint16_t port, std::string actor);

    /// Where to come to, as a driver names it: "s.sock", "127.0.0.1:2000".
    std::string place() const;

    /// Waits for the driver, a connected socket. Throws ChannelFault when none came in time.
    int let_in(const Patience& patience);

    /// Turns away whoever has come meanwhile. `is_over`: the run has ended before there was
    /// somebody to drive; else because somebody drives already. Does not wait.
    void turn_others_away(bool is_over = false);

  private:
    bool may_come(int descriptor) const;

    std::filesystem::path path_;  ///< empty: TCP
    std::string actor_;
    Listener listener_;
};

}  // namespace reprise::remote

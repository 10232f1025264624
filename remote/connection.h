#pragma once

#include <string>

namespace reprise::remote {

/// Connects to where a run or a server waits: "PATH" of a socket or "HOST:PORT". Returns the
/// socket. Throws world::Error, "s.sock: nobody is there: ...".
int open_connection(const std::string& address);

}  // namespace reprise::remote

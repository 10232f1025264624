#include "remote/seat_plan.h"

#include <charconv>
#include <string_view>

#include "world/check.h"
#include "world/printable.h"

namespace reprise::remote {

namespace {

constexpr std::string_view socket_word = "socket:";
constexpr std::string_view port_word = "tcp:";

std::uint16_t port_of(const std::string& digits, const std::string& text) {
    std::uint16_t port = 0;
    const char* const end = digits.data() + digits.size();
    if (const auto read = std::from_chars(digits.data(), end, port);
        read.ec != std::errc() || read.ptr != end)
        throw world::Error("--driver " + text +
                           ": expected tcp:PORT with a port of this machine, 1 to 65535, or 0 for "
                           "one that is free");
    return port;
}

}  // namespace

SeatPlan parse_seat(const std::string& said) {
    const std::string text = world::printable(said);  // for messages
    const auto equals = said.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == said.size())
        throw world::Error("--driver " + text +
                           ": expected NAME=COMMAND, NAME=socket:PATH or NAME=tcp:PORT");
    SeatPlan plan{said.substr(0, equals)};
    const std::string who = said.substr(equals + 1);
    if (who.starts_with(socket_word))
        plan.socket = who.substr(socket_word.size());
    else if (who.starts_with(port_word))
        plan.port = port_of(who.substr(port_word.size()), text);
    else
        plan.command = who;
    if (plan.command.empty() && plan.socket.empty() && !plan.port)
        throw world::Error("--driver " + text + ": 'socket:' needs a path");
    return plan;
}

}  // namespace reprise::remote

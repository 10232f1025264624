#pragma once

#include <string>
#include <string_view>

namespace reprise::exchange {

/// RFC 4648, section 4: how JSON messages and web pages carry bytes.
std::string base64(std::string_view bytes);

}  // namespace reprise::exchange

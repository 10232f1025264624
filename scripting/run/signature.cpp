#include "scripting/run/signature.h"

#include "world/check.h"

namespace reprise::scripting {

namespace {

std::string without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    if (first == std::string_view::npos)
        return "";
    return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

/// The bracket that closes the one at `open`.
std::size_t closing(std::string_view text, std::size_t open) {
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
        depth += text[i] == '(' ? 1 : 0;
        depth -= text[i] == ')' ? 1 : 0;
        if (depth == 0)
            return i;
    }
    return std::string_view::npos;
}

}  // namespace

std::vector<std::string> split_type(std::string_view type, char separator) {
    std::vector<std::string> parts;
    int depth = 0;
    std::size_t start = 0;
    for (std::size_t i = 0; i <= type.size(); ++i) {
        const char c = i < type.size() ? type[i] : separator;
        depth += c == '(' || c == '{' || c == '<' ? 1 : 0;
        depth -= c == ')' || c == '}' || c == '>' ? 1 : 0;
        if (c != separator || depth != 0)
            continue;
        if (std::string part = without_blanks(type.substr(start, i - start)); !part.empty())
            parts.push_back(std::move(part));
        start = i + 1;
    }
    return parts;
}

Signature read_signature(std::string_view text) {
    Signature signature;
    const std::size_t end = closing(text, 0);
    REPRISE_CHECK(!text.empty() && text.front() == '(' && end != std::string_view::npos,
                  std::string(text));
    for (const std::string& part : split_type(text.substr(1, end - 1), ',')) {
        Signature::Parameter parameter;
        const std::size_t colon = part.find(':');
        parameter.name = without_blanks(part.substr(0, colon));
        parameter.type =
            colon == std::string::npos ? "any" : without_blanks(part.substr(colon + 1));
        parameter.optional = parameter.name.ends_with('?');
        if (parameter.optional)
            parameter.name.pop_back();
        signature.parameters.push_back(std::move(parameter));
    }
    const std::string_view behind = text.substr(end + 1);
    if (const std::size_t colon = behind.find(':'); colon != std::string_view::npos)
        signature.returns = split_type(behind.substr(colon + 1), ',');
    return signature;
}

}  // namespace reprise::scripting

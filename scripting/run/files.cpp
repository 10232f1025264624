#include "scripting/run/files.h"

#include <fstream>
#include <iterator>
#include <set>
#include <variant>

#include <fmt/format.h>

#include "scripting/lua/literals.h"
#include "scripting/lua/tokens.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr std::string_view ending = ".csv";

std::string text_of_file(const std::filesystem::path& path, const std::string& name) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw world::Error(fmt::format("'{}', which the scenario names, is not a file", name));
    if (std::filesystem::file_size(path, error) > longest_companion)
        throw world::Error(
            fmt::format("'{}', which the scenario names, is larger than 1 MB", name));
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file)
        throw world::Error(fmt::format("cannot read '{}', which the scenario names", name));
    return text;
}

}  // namespace

bool is_plain_name(std::string_view name) {
    return !name.empty() && name.front() != '.' && name.size() <= 100 &&
           name.find_first_of("/\\:") == std::string_view::npos &&
           name.find('\0') == std::string_view::npos;
}

std::vector<world::FileT> companions_of(const std::string& source,
                                        const std::vector<world::ParameterT>& parameters,
                                        const std::filesystem::path& folder) {
    std::set<std::string> names;
    const auto note = [&](std::string_view text) {
        if (text.ends_with(ending) && is_plain_name(text))
            names.emplace(text);
    };
    Tokens tokens(source);
    for (Token token = tokens.next(); token.kind != Token::Kind::end; token = tokens.next())
        if (token.kind == Token::Kind::text)
            note(token.spelling);
    for (const world::ParameterT& parameter : parameters)
        if (const auto value = parse_literal(parameter.value))
            if (const auto* text = std::get_if<std::string>(&*value))
                note(*text);
    std::vector<world::FileT> files;
    for (const std::string& name : names) {
        std::error_code error;
        const std::filesystem::path path = folder / name;
        if (!std::filesystem::exists(path, error))
            continue;
        world::FileT file;
        file.name = name;
        file.text = text_of_file(path, name);
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace reprise::scripting

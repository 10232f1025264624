#include "scripting/spawned_names.h"

#include "scripting/lua/tokens.h"
#include "world/models/catalogue.h"

namespace reprise::scripting {

namespace {

/// 'sedan' of 'sedan_2'; empty where no model is called so.
std::string_view model_in(std::string_view name) {
    const std::size_t end = name.find_last_not_of("0123456789");
    const bool numbered =
        end != std::string_view::npos && end + 1 < name.size() && end > 0 && name[end] == '_';
    const std::string_view model = numbered ? name.substr(0, end) : name;
    return world::find_vehicle_model(model) ? model : std::string_view();
}

bool is_join(const Token& token) {
    return token.kind == Token::Kind::symbol && token.spelling == "..";
}

/// Up to what a format puts in.
std::string_view before_format(std::string_view text) {
    return text.substr(0, text.find('%'));
}

}  // namespace

bool may_name(std::string_view source, std::string_view name) {
    const std::string_view model = model_in(name);
    Tokens tokens(source);
    Token before;
    for (Token token = tokens.next(); token.kind != Token::Kind::end;) {
        const Token behind = tokens.next();
        if (token.kind == Token::Kind::text && !token.spelling.empty()) {
            const std::string_view text = token.spelling;
            const std::string_view begin = before_format(text);
            if (text == name || (!model.empty() && text == model) ||
                (is_join(behind) && name.starts_with(text)) ||
                (is_join(before) && name.ends_with(text)) ||
                (begin.size() < text.size() && !begin.empty() && name.starts_with(begin)))
                return true;
        }
        before = token;
        token = behind;
    }
    return false;
}

}  // namespace reprise::scripting

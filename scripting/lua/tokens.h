#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace reprise::scripting {

/// A word of Lua source as its compiler reads it.
struct Token {
    enum class Kind : std::uint8_t { end, name, text, number, symbol };

    Kind kind = Kind::end;
    std::string_view spelling;  ///< of a text what is between its quotes; keywords are names
    std::uint32_t line = 1;     ///< where it begins
};

/// Reads Lua source word by word. What is no Lua ends it: the compiler says why.
class Tokens {
  public:
    explicit Tokens(std::string_view source) : source_(source) {}

    Token next();

  private:
    void skip_blanks();
    bool skip_comment();
    Token text(char quote);
    Token long_text(std::size_t level);
    Token number();
    Token symbol();
    Token cut(Token::Kind kind, std::size_t start, std::size_t end, std::size_t behind);
    std::size_t long_bracket() const;

    char at(std::size_t place) const { return place < source_.size() ? source_[place] : '\0'; }

    std::string_view source_;
    std::size_t place_ = 0;
    std::uint32_t line_ = 1;
};

}  // namespace reprise::scripting

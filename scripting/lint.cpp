#include "scripting/lint.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "scripting/known_words.h"
#include "scripting/lua/tokens.h"
#include "scripting/run/signature.h"
#include "world/check.h"

// What must it do?     Name each thing in a scenario that is not there, with its line.
// What does it assume? That Lua's compiler took the source, so that brackets close.
// How?                 One walk over the tokens. A stack of brackets knows whose arguments or keys
//                      stand there, from the signatures of the vocabulary. Names that are declared
//                      anywhere in the file count as declared everywhere in it.
// What does it keep?   Nothing.
namespace reprise::scripting {

namespace {

using Kind = Token::Kind;

const Names& keywords() {
    static const Names words{"and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
                             "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
                             "repeat",   "return", "then", "true", "until",  "while"};
    return words;
}

/// A bracket that is open.
struct Bracket {
    char opens = '(';
    const Signature* callee = nullptr;  ///< of '(', where it is known
    std::size_t argument = 0;           ///< of '(': the one that is read
    std::string type;                   ///< of '{', where it is known
    std::string value_type;             ///< of '{': of the value that is read
    bool parameters = false;            ///< it is the header's `params`
};

class Lint {
  public:
    Lint(std::string_view source, const world::TownT* town) : town_(town) {
        Tokens tokens(source);
        for (Token token = tokens.next(); token.kind != Kind::end; token = tokens.next())
            tokens_.push_back(token);
        // So that two tokens behind and ahead of each can be asked for.
        end_.line = tokens_.empty() ? 1 : tokens_.back().line;
        declare();
    }

    std::vector<Finding> run() {
        for (at_ = 0; at_ < tokens_.size(); ++at_)
            look();
        for (const auto& [line, name] : parameters_read_)
            judge_parameter(line, name);
        for (const auto& [name, line] : parameters_)
            if (fields_read_.count(name) == 0 && texts_.count(name) == 0)
                find(line, fmt::format("the parameter '{}' is never used", name));
        std::stable_sort(findings_.begin(),
                         findings_.end(),
                         [](const Finding& a, const Finding& b) { return a.line < b.line; });
        return std::move(findings_);
    }

  private:
    const Token& token(std::ptrdiff_t offset = 0, std::size_t from = npos) const {
        const auto place = static_cast<std::ptrdiff_t>(from == npos ? at_ : from) + offset;
        return place < 0 || place >= static_cast<std::ptrdiff_t>(tokens_.size())
                   ? end_
                   : tokens_[static_cast<std::size_t>(place)];
    }

    bool is(std::ptrdiff_t offset, std::string_view spelling, std::size_t from = npos) const {
        const Token& asked = token(offset, from);
        return asked.spelling == spelling && asked.kind != Kind::text;
    }

    bool is_name(std::ptrdiff_t offset, std::size_t from = npos) const {
        const Token& asked = token(offset, from);
        return asked.kind == Kind::name && keywords().count(asked.spelling) == 0;
    }

    /// '=' and not '==' (nor behind '<', '>', '~').
    bool is_assignment(std::ptrdiff_t offset, std::size_t from = npos) const {
        const Token& equals = token(offset, from);
        const Token& next = token(offset + 1, from);
        return is(offset, "=", from) &&
               !(is(offset + 1, "=", from) && next.spelling.data() == equals.spelling.data() + 1);
    }

    void find(std::uint32_t line, std::string message) {
        findings_.push_back({line, std::move(message)});
    }

    /// Notes every name that is declared anywhere, and every field that is given a value.
    void declare() {
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            if (is(0, "local", i) || is(0, "for", i)) {
                for (std::size_t j = i + (is(1, "function", i) ? 2 : 1); j < tokens_.size(); ++j) {
                    if (is_name(0, j))
                        ++declared_[std::string(tokens_[j].spelling)];
                    if (is(1, "<", j))
                        j += 3;  // <const>
                    if (!is(1, ",", j))
                        break;
                    ++j;
                }
            } else if (is(0, "function", i)) {
                std::size_t j = i + 1;
                for (; j < tokens_.size() && !is(0, "(", j); ++j)
                    if (is(-1, ".", j) || is(-1, ":", j))
                        fields_given_.emplace(tokens_[j].spelling);
                for (++j; j < tokens_.size() && !is(0, ")", j); ++j)
                    if (is_name(0, j))
                        ++declared_[std::string(tokens_[j].spelling)];
            }
            if (is_name(0, i) && is_assignment(1, i) && !is(-1, "local", i))
                fields_given_.emplace(tokens_[i].spelling);
            if (tokens_[i].kind == Kind::text)
                texts_.emplace(tokens_[i].spelling);
        }
    }

    void look() {
        const Token& here = token();
        if (here.kind == Kind::text)
            look_at_text();
        else if (is_name(0))
            look_at_name();
        else if (is(0, "(") || is(0, "{") || is(0, "["))
            open();
        else if (is(0, ")") || is(0, "}") || is(0, "]"))
            close();
        else if ((is(0, ",") || is(0, ";")) && !open_.empty()) {
            ++open_.back().argument;
            open_.back().value_type.clear();
        }
        // Commas between the names and values of a function's own statements are not the call's.
        if (is(0, "function"))
            open_.push_back({'f', nullptr, 0, "", "", false});
        else if (is(0, "then") || is(0, "do") || is(0, "repeat"))
            open_.push_back({'b', nullptr, 0, "", "", false});
        else if ((is(0, "end") || is(0, "until") || is(0, "elseif") || is(0, "else")) &&
                 !open_.empty()) {
            open_.pop_back();
            if (is(0, "else"))
                open_.push_back({'b', nullptr, 0, "", "", false});
        }
    }

    /// What is called by a bracket or a text at `at_`, if it is a word of ours.
    const Signature* called() const {
        if (token(-1).kind == Kind::text && is(-2, "scenario"))
            return &language_.header;
        if (is(-1, ")") && closed_ != nullptr &&
            closed_ == language_.find(Owner::global, "scenario"))
            return &language_.header;
        if (!is_name(-1))
            return nullptr;
        if (is(-2, ":"))
            return language_.find(Owner::actor, token(-1).spelling);
        if (is(-2, "."))
            return is(-3, "check") ? language_.find(Owner::check, token(-1).spelling) : nullptr;
        const bool hidden = is(-2, "function") || declared_.count(token(-1).spelling) != 0;
        return hidden ? nullptr : language_.find(Owner::global, token(-1).spelling);
    }

    static std::string type_at(const Signature& callee, std::size_t argument) {
        return argument < callee.parameters.size() ? callee.parameters[argument].type : "";
    }

    /// The type that the signatures want of a value that begins at `at_`; "" where they say
    /// nothing.
    std::string wanted_type() const {
        if (const Signature* callee = called())
            return type_at(*callee, 0);
        if (open_.empty())
            return "";
        const Bracket& around = open_.back();
        const bool begins = is(-1, "(") || is(-1, ",") || is(-1, "{") || is(-1, ";");
        if (around.opens == '(' && around.callee != nullptr && begins)
            return type_at(*around.callee, around.argument);
        if (around.opens == '{' && is(-1, "="))
            return around.value_type;
        if (around.opens == '{' && begins && around.type.ends_with("[]"))
            return around.type.substr(0, around.type.size() - 2);
        return "";
    }

    void open() {
        Bracket bracket;
        bracket.opens = token().spelling.front();
        if (is(0, "("))
            bracket.callee = called();
        if (is(0, "{")) {
            bracket.type = wanted_type();
            bracket.parameters =
                !open_.empty() && open_.back().type == "ScenarioHeader" && is(-2, "params");
        }
        open_.push_back(std::move(bracket));
    }

    void close() {
        if (open_.empty())
            return;
        closed_ = is(0, ")") ? open_.back().callee : nullptr;
        open_.pop_back();
    }

    /// The keys that a table of this type may have; none when it may have others.
    std::optional<std::map<std::string, std::string, std::less<>>> allowed_keys(
        const std::string& type) const {
        std::map<std::string, std::string, std::less<>> keys;
        for (const std::string& part : split_type(type, '|')) {
            const auto list = language_.keys.find(part);
            if (list != language_.keys.end())
                keys.insert(list->second.begin(), list->second.end());
            else if (part.find_first_of("{[<") != std::string::npos || part == "table" ||
                     part == "any")
                return std::nullopt;
        }
        return keys.empty() ? std::nullopt : std::optional(keys);
    }

    void look_at_key() {
        Bracket& table = open_.back();
        const std::string key(token().spelling);
        if (table.parameters)
            parameters_.emplace(key, token().line);
        if (table.type == "ScenarioHeader" && key == "params" && !is(2, "{"))
            parameters_elsewhere_ = true;
        if (table.type == "ScenarioHeader" && key == "run" && is(2, "function") && is_name(4))
            run_argument_ = token(4).spelling;
        const auto allowed = allowed_keys(table.type);
        if (!allowed)
            return;
        const auto known = allowed->find(key);
        if (known != allowed->end()) {
            table.value_type = known->second;
            return;
        }
        std::vector<std::string> names;
        for (const auto& [name, type] : *allowed)
            names.push_back(name);
        find(token().line,
             fmt::format("unknown key '{}'{}; there are {}",
                         key,
                         world::did_you_mean(key, names),
                         joined(names)));
    }

    void look_at_name() {
        const bool separated = is(-1, "{") || is(-1, ",") || is(-1, ";");
        if (!open_.empty() && open_.back().opens == '{' && separated && is_assignment(1))
            return look_at_key();
        if (is(-1, "::") || is(-1, "goto"))
            return;
        if (is(-1, ":"))
            return look_at_method();
        if (is(-1, "."))
            return look_at_field();
        const std::string name(token().spelling);
        const bool attribute = is(-1, "<") && is(1, ">") && (name == "const" || name == "close");
        if (declared_.count(name) != 0 || attribute)
            return;
        const Names& ours = language_.names.at(Owner::global);
        if (name == "check" || ours.count(name) != 0 || libraries_.globals.count(name) != 0)
            return;
        if (is_assignment(1) || is(-1, "function"))
            return find(
                token().line,
                fmt::format(
                    "'{}' would be a global: write 'local {}' where it first appears", name, name));
        std::vector<std::string> known = list_of(ours);
        for (const auto& [declared, times] : declared_)
            known.push_back(declared);
        find(token().line,
             fmt::format("no variable or function '{}'{}", name, world::did_you_mean(name, known)));
    }

    void judge_parameter(std::uint32_t line, const std::string& name) {
        if (parameters_elsewhere_ || parameters_.count(name) != 0)
            return;
        std::vector<std::string> names;
        for (const auto& [parameter, where] : parameters_)
            names.push_back(parameter);
        find(line,
             fmt::format("no parameter '{}'{}; the header's params has {}",
                         name,
                         world::did_you_mean(name, names),
                         names.empty() ? "none" : joined(names)));
    }

    void look_at_method() {
        const std::string name(token().spelling);
        const Names& of_tasks = language_.names.at(Owner::task);
        const Names& ours = language_.names.at(Owner::actor);
        if (of_tasks.count(name) != 0 || is(-3, "function") || ours.count(name) != 0 ||
            fields_given_.count(name) != 0 || libraries_.fields.at("string").count(name) != 0)
            return;
        find(token().line,
             fmt::format("an actor has no '{}'{}", name, world::did_you_mean(name, list_of(ours))));
    }

    void look_at_field() {
        const std::string name(token().spelling);
        fields_read_.insert(name);
        if (is(-3, ".") || is(-3, ":"))
            return;
        const std::string owner(token(-2).spelling);
        const auto declared = declared_.find(owner);
        if (owner == run_argument_ && declared != declared_.end() && declared->second == 1 &&
            !is_assignment(1))
            parameters_read_.emplace(token().line, name);
        if (declared != declared_.end())
            return;
        const auto library = libraries_.fields.find(owner);
        const Names* fields = owner == "check" ? &language_.names.at(Owner::check)
                              : library != libraries_.fields.end() ? &library->second
                                                                   : nullptr;
        if (fields != nullptr && fields->count(name) == 0)
            find(token().line,
                 fmt::format(
                     "{} has no '{}'{}", owner, name, world::did_you_mean(name, list_of(*fields))));
    }

    /// A text that is a whole value is looked up in what may stand there.
    void look_at_text() {
        const std::string type = wanted_type();
        const bool whole =
            is(1, ",") || is(1, ";") || is(1, ")") || is(1, "}") || called() != nullptr;
        if (!type.empty() && whole && token().spelling.find('\\') == std::string_view::npos)
            if (auto mistake = language_.mistake_in(std::string(token().spelling), type, town_))
                find(token().line, std::move(*mistake));
    }

    static constexpr std::size_t npos = std::string_view::npos;

    const world::TownT* town_;
    Libraries libraries_;
    Language language_;
    std::vector<Token> tokens_;
    Token end_;
    std::size_t at_ = 0;
    std::map<std::string, int, std::less<>> declared_;  ///< how often
    Names fields_given_;
    Names fields_read_;
    Names texts_;
    std::vector<Bracket> open_;
    const Signature* closed_ = nullptr;                ///< of the parenthesis that closed last
    std::map<std::string, std::uint32_t> parameters_;  ///< of the header: line
    std::set<std::pair<std::uint32_t, std::string>> parameters_read_;  ///< line, name
    bool parameters_elsewhere_ = false;  ///< the header's `params` is no table written there
    std::string run_argument_;           ///< what the run function calls them
    std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> lint(std::string_view source, const world::TownT* town) {
    return Lint(source, town).run();
}

}  // namespace reprise::scripting

#include "scripting/annotations.h"

#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "scripting/run/signature.h"
#include "scripting/words/vocabulary.h"
#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/weather/weather.h"

namespace reprise::scripting {

namespace {

/// "---@alias WeatherName 'a'|'b'".
template <typename List, typename Name>
std::string alias(const char* type, const List& list, const Name& name) {
    std::string text = fmt::format("---@alias {} ", type);
    bool first = true;
    for (const auto& entry : list) {
        text += fmt::format("{}'{}'", first ? "" : "|", name(entry));
        first = false;
    }
    return text + "\n";
}

std::string aliases() {
    const auto of_row = [](const auto& row) { return std::string_view(row.name); };
    const auto itself = [](const auto& word) { return std::string_view(word); };
    return alias("ModelName", world::vehicle_models(), of_row) +
           alias("WalkerName", world::walker_models(), of_row) +
           alias("PropName", world::prop_models(), of_row) +
           alias("WeatherName", world::weather_names(), itself) +
           alias("DriverName", driver_names(), itself) +
           "---@alias LaneName string\n"
           "---@alias LaneOrEdgeName string\n";
}

std::string key_class(const KeyList& list) {
    std::string text = fmt::format("\n--- What {} takes.\n---@class {}\n", list.word, list.type);
    for (const Key& key : list.keys)
        text += fmt::format(
            "---@field {}{} {} {}\n", key.name, key.required ? "" : "?", key.type, key.meaning);
    return text;
}

/// "spawn(options)" as Lua declares it, with what stands above.
std::string declaration(const WordList& list, const Word& word) {
    const Signature signature = read_signature(word.signature);
    std::string text = fmt::format("\n--- {}\n", word.meaning);
    std::string names;
    for (const Signature::Parameter& parameter : signature.parameters) {
        text += fmt::format(
            "---@param {}{} {}\n", parameter.name, parameter.optional ? "?" : "", parameter.type);
        names += (names.empty() ? "" : ", ") + parameter.name;
    }
    for (const std::string& type : signature.returns)
        text += fmt::format("---@return {}\n", type);
    const char* owner = list.owner == Owner::actor   ? "Actor:"
                        : list.owner == Owner::check ? "check."
                        : list.owner == Owner::task  ? "Task:"
                                                     : "";
    return text + fmt::format("function {}{}({}) end\n", owner, word.name, names);
}

/// A `|` would end a cell.
std::string in_cell(std::string_view text) {
    std::string cell;
    for (const char c : text)
        cell += c == '|' ? std::string("\\|") : std::string(1, c);
    return cell;
}

std::string spoken(const WordList& list, const Word& word) {
    const char* owner = list.owner == Owner::actor   ? "ego:"
                        : list.owner == Owner::check ? "check."
                        : list.owner == Owner::task  ? "task:"
                                                     : "";
    return std::string(owner) + word.name + word.signature;
}

}  // namespace

std::string annotations() {
    std::string text =
        "---@meta\n"
        "-- The words of a scenario, for editors: written by `reprise list words --luals`.\n\n" +
        aliases();
    for (const KeyList& list : vocabulary_keys())
        text += key_class(list);
    text +=
        "\n--- Who was spawned.\n---@class Actor\nlocal Actor = {}\n\n"
        "--- What start() began.\n---@class Task\nlocal Task = {}\n\ncheck = {}\n";
    for (const WordList& list : vocabulary()) {
        text += fmt::format("\n-- {}\n", list.group);
        for (const Word& word : list.words)
            text += declaration(list, word);
    }
    return text;
}

std::string words_page() {
    std::string text =
        "# Every word\n\n"
        "Made of the program's own table by `reprise list words --markdown`; a test holds it "
        "against "
        "that. Types are written as the\nLua language server does; `?` marks what may be left out. "
        "What the words mean: [scenarios.md](scenarios.md).\n";
    for (const WordList& list : vocabulary()) {
        text += fmt::format("\n## {}\n\n| word | |\n| --- | --- |\n", list.group);
        for (const Word& word : list.words)
            text += fmt::format("| `{}` | {} |\n", in_cell(spoken(list, word)), word.meaning);
    }
    text += "\n# Every key\n";
    for (const KeyList& list : vocabulary_keys()) {
        text += fmt::format(
            "\n## {}, of {}\n\n| key | | |\n| --- | --- | --- |\n", list.type, list.word);
        for (const Key& key : list.keys)
            text += fmt::format("| `{}{}` | `{}` | {} |\n",
                                key.name,
                                key.required ? "" : "?",
                                in_cell(key.type),
                                key.meaning);
    }
    return text;
}

}  // namespace reprise::scripting

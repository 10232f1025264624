#include "scripting/known_words.h"

#include <algorithm>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/sandbox.h"
#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"
#include "scripting/run/places.h"
#include "scripting/words/vocabulary.h"
#include "world/check.h"
#include "world/models/catalogue.h"
#include "world/weather/weather_text.h"

namespace reprise::scripting {

namespace {

/// Keys of the table at the top of the stack, which is popped.
Names keys_of(lua_State* L) {
    Names names;
    for (lua_pushnil(L); lua_next(L, -2) != 0; lua_pop(L, 1))
        if (lua_type(L, -2) == LUA_TSTRING)
            names.insert(text_of(L, -2));
    lua_pop(L, 1);
    return names;
}

/// The values that a type names one by one.
struct Choices {
    std::vector<std::string> values;
    const char* what = "choice";  ///< one of them
    bool many = false;            ///< too many for a message
    bool weather = false;         ///< or numbers of one
    bool lane = false;            ///< a lane is one as well
    bool edge = false;            ///< an edge, too
    bool any = false;             ///< any text is
};

Choices choices_of(const Language& language, const std::string& type) {
    static const Names no_text{"number", "integer", "boolean", "Actor", "Task", "table", "table[]"};
    Choices choices;
    for (const std::string& part : split_type(type, '|')) {
        if (part.front() == '\'') {
            choices.values.push_back(part.substr(1, part.size() - 2));
        } else if (part == "ModelName" || part == "WalkerName" || part == "PropName") {
            choices.values = world::model_names();
            choices.what = "model";
            choices.many = true;
        } else if (part == "WeatherName") {
            choices.weather = true;
        } else if (part == "DriverName") {
            choices.values = driver_names();
            choices.what = "driver";
        } else if (part == "LaneName" || part == "LaneOrEdgeName") {
            choices.lane = true;
            choices.edge = part == "LaneOrEdgeName";
        } else if (language.keys.count(part) == 0 && no_text.count(part) == 0 &&
                   part.find("fun(") == std::string::npos) {
            choices.any = true;
        }
    }
    return choices;
}

}  // namespace

std::vector<std::string> list_of(const Names& names) {
    return {names.begin(), names.end()};
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

Libraries::Libraries() {
    Vm vm("lint");
    lua_State* L = vm.main();
    push_sandbox(L);  // vocabulary, environment
    lua_pushvalue(L, -2);
    globals = keys_of(L);
    for (const char* library : {"string", "table", "math", "utf8"}) {
        lua_getfield(L, -2, library);
        fields.emplace(library, keys_of(L));
    }
    lua_settop(L, 0);
}

Language::Language() {
    for (const WordList& list : vocabulary())
        for (const Word& word : list.words) {
            words[list.owner].emplace(word.name, read_signature(word.signature));
            names[list.owner].insert(word.name);
        }
    for (const KeyList& list : vocabulary_keys())
        for (const Key& key : list.keys)
            keys[list.type].emplace(key.name, key.type);
    header.parameters.push_back({"header", "ScenarioHeader", false});
}

const Signature* Language::find(Owner owner, std::string_view name) const {
    const auto& of_owner = words.at(owner);
    const auto found = of_owner.find(name);
    return found == of_owner.end() ? nullptr : &found->second;
}

std::optional<std::string> Language::mistake_in(const std::string& text,
                                                const std::string& type,
                                                const world::TownT* town) const {
    const Choices choices = choices_of(*this, type);
    const auto& values = choices.values;
    if (choices.any || std::find(values.begin(), values.end(), text) != values.end())
        return std::nullopt;
    if (choices.lane) {
        if (town == nullptr)
            return std::nullopt;
        try {
            if (choices.edge)
                stop_named(*town, text);
            else
                lane_named(*town, text);
        } catch (const world::Error& error) {
            return error.what();
        }
        return std::nullopt;
    }
    if (choices.weather) {
        try {
            world::read_weather(text);
        } catch (const world::Error& error) {
            return error.what();
        }
        return std::nullopt;
    }
    if (values.empty())
        return fmt::format("a text, '{}', where {} is expected", text, type);
    return fmt::format("no {} '{}'{}; there are {}",
                       choices.what,
                       text,
                       world::did_you_mean(text, values),
                       choices.many ? "many: reprise list models, walkers" : joined(values));
}

}  // namespace reprise::scripting

// A golden's file: JSON, laid out with one fact a line.
//   must      refuse every file that `accept` did not write: edited, merged, cut off, reordered
//   goes      keys_of says each struct's keys once, for writing and reading; what was read is
//             written again and must be the same bytes
#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/golden/golden.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::replay {

namespace {

using Json = nlohmann::ordered_json;
using NamedTexts = std::vector<std::pair<std::string, std::string>>;

constexpr int golden_format = 3;  ///< counted up when a key gets another meaning
constexpr std::string_view file_start = "{\n\"reprise_golden\": ";
constexpr std::string_view seal_start = ",\n\"seal\": ";
constexpr const char* note =
    "`reprise test` compares a run with this, `reprise accept` writes it; not for editing. Tick n "
    "is n * step_ns after the start. Metres, metres a second, radians; every digit counts.";
constexpr const char* remedy = "restore the file, or remove it and accept the case again";

template <typename Member>
struct Key {
    const char* name;
    Member member;
};

template <typename Member>
Key(const char*, Member) -> Key<Member>;  // clang 14 finds none by itself

auto keys_of(const world::ParameterT*) {
    return std::tuple(Key{"key", &world::ParameterT::key}, Key{"value", &world::ParameterT::value});
}

auto keys_of(const Sampling*) {
    return std::tuple(Key{"checkpoints", &Sampling::checkpoints}, Key{"states", &Sampling::states});
}

auto keys_of(const GivenSetup*) {
    return std::tuple(Key{"town", &GivenSetup::town},
                      Key{"seed", &GivenSetup::seed},
                      Key{"for", &GivenSetup::seconds},
                      Key{"set", &GivenSetup::parameters});
}

auto keys_of(const GoldenCheck*) {
    return std::tuple(Key{"name", &GoldenCheck::name},
                      Key{"status", &GoldenCheck::status},
                      Key{"tick", &GoldenCheck::tick},
                      Key{"line", &GoldenCheck::line},
                      Key{"detail", &GoldenCheck::detail});
}

auto keys_of(const GoldenEvent*) {
    return std::tuple(Key{"tick", &GoldenEvent::tick},
                      Key{"kind", &GoldenEvent::kind},
                      Key{"line", &GoldenEvent::line},
                      Key{"actor", &GoldenEvent::actor},
                      Key{"other", &GoldenEvent::other},
                      Key{"value", &GoldenEvent::value},
                      Key{"place", &GoldenEvent::place},
                      Key{"text", &GoldenEvent::text});
}

auto keys_of(const Checkpoint*) {
    return std::tuple(Key{"tick", &Checkpoint::tick},
                      Key{"history", &Checkpoint::history},
                      Key{"stages", &Checkpoint::stages});
}

auto keys_of(const BackgroundState*) {
    return std::tuple(Key{"tick", &BackgroundState::tick},
                      Key{"cars", &BackgroundState::cars},
                      Key{"walkers", &BackgroundState::walkers},
                      Key{"digest", &BackgroundState::digest});
}

auto keys_of(const ActorState*) {
    return std::tuple(Key{"tick", &ActorState::tick},
                      Key{"actor", &ActorState::actor},
                      Key{"values", &ActorState::values});
}

auto keys_of(const Golden*) {
    return std::tuple(Key{"because", &Golden::because},
                      Key{"scenario", &Golden::scenario},
                      Key{"scenario_digest", &Golden::scenario_digest},
                      Key{"given", &Golden::given},
                      Key{"pins", &Golden::pins},
                      Key{"build", &Golden::build},
                      Key{"start", &Golden::starts},
                      Key{"chain", &Golden::chain},
                      Key{"step_ns", &Golden::step_ns},
                      Key{"every", &Golden::sampling},
                      Key{"verdict", &Golden::verdict},
                      Key{"reason", &Golden::reason},
                      Key{"ticks", &Golden::ticks},
                      Key{"checks", &Golden::checks},
                      Key{"events", &Golden::events},
                      Key{"checkpoints", &Golden::checkpoints},
                      Key{"background", &Golden::background},
                      Key{"states", &Golden::states});
}

template <typename Value>
concept HasKeys = requires(const Value* value) {
    keys_of(value);
};

template <typename Value>
concept ListOfThese = requires {
    requires HasKeys<typename Value::value_type>;
};

/// What is empty or 0 is left out of its object.
template <typename Value>
Json json_of(const Value& value) {
    if constexpr (HasKeys<Value>) {
        Json json = Json::object();
        const auto put = [&](const auto& key) {
            Json member = json_of(value.*key.member);
            if (!member.empty() && member != "" && member != 0)
                json[key.name] = std::move(member);
        };
        std::apply([&](const auto&... key) { (put(key), ...); }, keys_of(&value));
        return json;
    } else if constexpr (ListOfThese<Value>) {
        Json json = Json::array();
        for (const auto& item : value)
            json.push_back(json_of(item));
        return json;
    } else if constexpr (std::is_same_v<Value, NamedTexts>) {
        Json json = Json::object();
        for (const auto& [name, text] : value)
            json[name] = text;
        return json;
    } else {
        return value;
    }
}

/// The other way round. Keys that are not known are passed over.
template <typename Value>
void read(const Json& json, Value& value) {
    if constexpr (HasKeys<Value>) {
        const auto take = [&](const auto& key) {
            if (const auto member = json.find(key.name); member != json.end())
                read(*member, value.*key.member);
        };
        std::apply([&](const auto&... key) { (take(key), ...); }, keys_of(&value));
    } else if constexpr (ListOfThese<Value>) {
        for (const Json& item : json)
            read(item, value.emplace_back());
    } else if constexpr (std::is_same_v<Value, NamedTexts>) {
        for (const auto& [name, text] : json.items())
            value.emplace_back(name, text.template get<std::string>());
    } else {
        json.get_to(value);
    }
}

std::string with_commas(const std::vector<std::string>& lines) {
    return fmt::format("{}", fmt::join(lines, ",\n"));
}

/// A line for each member, without the braces around all; for a list or an object a line for each
/// of its own.
std::string laid_out(const Json& json) {
    std::vector<std::string> lines;
    for (const auto& [key, value] : json.items()) {
        std::vector<std::string> inner;
        for (const auto& [name, item] : value.items())
            inner.push_back((value.is_object() ? Json(name).dump() + ": " : "") + item.dump());
        const std::string all = value.is_array()    ? "[\n" + with_commas(inner) + "\n]"
                                : value.is_object() ? "{\n" + with_commas(inner) + "\n}"
                                                    : value.dump();
        lines.push_back(Json(key).dump() + ": " + all);
    }
    return with_commas(lines);
}

/// For people: the times of the ticks. They are not read back, but must be these.
void add_seconds(Json& items, std::uint64_t step_ns) {
    for (Json& item : items)
        if (item.contains("tick"))
            item["seconds"] = golden_seconds(item["tick"].get<std::uint64_t>(), step_ns);
}

std::string seal_of(std::string_view text) {
    world::Hasher hasher;
    hasher.add_text(text);
    return fmt::format("{}\"{:016x}\"\n}}\n", seal_start, hasher.digest64());
}

/// Mistakes in a golden's file.
struct GoldenFile {
    const std::string& text;
    const std::string& path;

    /// `at`: the byte at which something is wrong.
    [[noreturn]] void fail(std::size_t at, const std::string& what) const {
        at = std::min(at, text.size() - (text.empty() ? 0 : 1));
        const std::size_t end_before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
        const std::size_t start = end_before == std::string::npos ? 0 : end_before + 1;
        const std::string line = text.substr(start, text.find('\n', start) - start);
        throw world::Error(fmt::format(
            "{}:{}: {}: {}",
            path,
            1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(start), '\n'),
            what,
            line.size() < 60 ? line : line.substr(0, 60) + "..."));
    }

    void check_format() const {
        const bool is_first_format = text.starts_with("reprise golden 1");
        if (!is_first_format && !text.starts_with(file_start))
            fail(0, fmt::format("not a golden: it does not begin with '{}'", file_start.substr(2)));
        int format = 1;
        if (!is_first_format)
            std::from_chars(text.data() + file_start.size(), text.data() + text.size(), format);
        if (format != golden_format)
            fail(is_first_format ? 0 : 2,
                 fmt::format("a golden of format {}; this program reads format {}; remove the file "
                             "and accept the case again (reprise accept SCENARIO --because ...)",
                             format,
                             golden_format));
    }

    void check_seal() const {
        const std::size_t seal = text.rfind(seal_start);
        if (seal == std::string::npos)
            fail(text.size(), "cut off: a golden ends in its seal");
        if (std::string_view(text).substr(seal) != seal_of(std::string_view(text).substr(0, seal)))
            fail(seal + 2, std::string("the seal does not hold: edited, or merged; ") + remedy);
    }

    /// The first byte that would be written in another way.
    void check_spelling(const std::string& written) const {
        const auto differs =
            std::mismatch(text.begin(), text.end(), written.begin(), written.end()).first;
        if (text != written)
            fail(static_cast<std::size_t>(differs - text.begin()),
                 std::string("not as `reprise accept` writes it; ") + remedy);
    }
};

}  // namespace

std::string to_text(const Golden& golden) {
    Json json = json_of(golden);
    for (const char* list : {"checks", "events"})
        if (json.contains(list))
            add_seconds(json[list], golden.step_ns);
    try {
        const std::string text = fmt::format("{}{},\n\"note\": {},\n\"stages\": {},\n{}",
                                             file_start,
                                             golden_format,
                                             Json(note).dump(),
                                             Json(golden_stages()).dump(),
                                             laid_out(json));
        return text + seal_of(text);
    } catch (const Json::type_error&) {
        throw world::Error("a golden holds UTF-8 only; the reason or a parameter is not");
    }
}

Golden parse_golden(const std::string& text, const std::string& path) {
    const GoldenFile file{text, path};
    file.check_format();
    try {
        const Json json = Json::parse(text);
        file.check_seal();
        Golden golden;
        read(json, golden);
        if (golden.sampling.checkpoints == 0 || golden.sampling.states == 0)
            file.fail(0, "'every' 0 seconds is not possible");
        for (Checkpoint& checkpoint : golden.checkpoints)
            checkpoint.stages.resize(golden_stages().size());
        file.check_spelling(to_text(golden));
        return golden;
    } catch (const Json::parse_error& error) {
        file.fail(error.byte - 1, std::string("no JSON: cut off, or merged; ") + remedy);
    } catch (const Json::exception& error) {
        file.fail(0, error.what());
    }
}

Golden load_golden(const std::filesystem::path& path) {
    std::error_code ignored;
    std::ifstream in(path, std::ios::binary);
    if (!std::filesystem::is_regular_file(path, ignored) || !in)
        throw world::Error(path.string() + ": cannot be read");
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    return parse_golden(text, path.string());
}

}  // namespace reprise::replay

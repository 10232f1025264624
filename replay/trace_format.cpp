#include "replay/trace_format.h"

#include <charconv>

#include "world/digest.h"

namespace reprise::replay::format {

namespace {

std::string check_of(const std::map<std::string, std::string>& texts) {
    world::Hasher hasher;
    for (const auto& [key, value] : texts) {
        if (key == "check")
            continue;
        hasher.add_text(key);
        hasher.add_text(value);
    }
    return world::to_hex(hasher.digest128());
}

template <typename Noun, typename Draft>
mcap::Bytes pack_noun(const Draft& noun, const char* identifier) {
    flatbuffers::FlatBufferBuilder builder(1 << 16);
    builder.ForceDefaults(true);
    builder.Finish(Noun::Pack(builder, &noun), identifier);
    return {builder.GetBufferPointer(), builder.GetBufferPointer() + builder.GetSize()};
}

}  // namespace

std::map<std::string, std::string> with_check(std::map<std::string, std::string> texts) {
    texts["check"] = check_of(texts);
    return texts;
}

bool check_holds(const std::map<std::string, std::string>& texts) {
    const auto check = texts.find("check");
    return check != texts.end() && check->second == check_of(texts);
}

mcap::Bytes pack(const world::EpisodeT& episode) {
    return pack_noun<world::Episode>(episode, world::EpisodeIdentifier());
}

mcap::Bytes pack(const world::TownT& town) {
    return pack_noun<world::Town>(town, world::TownIdentifier());
}

world::Digest128 from_hex(const std::string& text) {
    std::uint64_t high = 0;
    std::uint64_t low = 0;
    if (text.size() != 32)
        return {};
    std::from_chars(text.data(), text.data() + 16, high, 16);
    std::from_chars(text.data() + 16, text.data() + 32, low, 16);
    return {low, high};
}

}  // namespace reprise::replay::format

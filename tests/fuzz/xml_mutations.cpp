#include "tests/fuzz/xml_mutations.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace reprise::test {

namespace {

struct Span {
    std::size_t from;
    std::size_t to;
};

/// Places of all values in quotes, without the quotes.
std::vector<Span> values_in(const std::string& xml) {
    std::vector<Span> found;
    for (std::size_t at = xml.find("=\""); at != std::string::npos; at = xml.find("=\"", at)) {
        const std::size_t end = std::min(xml.find('"', at + 2), xml.size());
        found.push_back({at + 2, end});
        at = end;
    }
    return found;
}

/// Places of all tags, with their brackets.
std::vector<Span> tags_in(const std::string& xml) {
    std::vector<Span> found;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == std::string::npos)
            break;
        found.push_back({at, end + 1});
    }
    return found;
}

constexpr std::array strange{"",          "0",     "-1",  "1e9",     "-1e300",  "nan",
                             "inf",       "99999", "abc", "0,0",     "1,2 1,2", "1e5,1e5,1e5 0,0",
                             "true",      "G",     "rrr", "\x1b[2J", "ü",       "all",
                             "passenger", "0.001", "180"};

}  // namespace

std::string mutated_xml(const std::string& xml, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto below = [&](std::size_t count) {
        return static_cast<std::size_t>(random()) % count;
    };
    const std::vector<Span> values = values_in(xml), tags = tags_in(xml);
    if (values.empty() || tags.empty())
        return xml;
    std::string out = xml;
    const Span value = values[below(values.size())], tag = tags[below(tags.size())];
    switch (below(5)) {
        case 0:
            out.replace(value.from, value.to - value.from, strange[below(strange.size())]);
            break;
        case 1: {
            const Span other = values[below(values.size())];
            out.replace(value.from, value.to - value.from, xml, other.from, other.to - other.from);
            break;
        }
        case 2:  // the attribute goes, name and all
            if (const std::size_t name = xml.rfind(' ', value.from); name != std::string::npos)
                out.erase(name, std::min(value.to + 1, xml.size()) - name);
            break;
        case 3:
            out.erase(tag.from, tag.to - tag.from);
            break;
        default:
            out.insert(tag.to, xml, tag.from, tag.to - tag.from);
    }
    return out;
}

}  // namespace reprise::test

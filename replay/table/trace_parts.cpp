#include "replay/table/trace_parts.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/mcap/files.h"
#include "replay/noun_check.h"
#include "replay/table/json_lines.h"
#include "replay/trace_format.h"
#include "replay/trace_index.h"
#include "world/check.h"

namespace reprise::replay {

namespace {

struct OpenTrace {
    const InputFile& file;
    const TraceIndex& index;
};

struct Part {
    const char* name;
    mcap::Bytes (*read)(const OpenTrace&);
};

mcap::Bytes to_bytes(const std::string& text) {
    return {text.begin(), text.end()};
}

/// FlatBuffers need to lie 8-aligned: what a vector allocates does.
template <typename Noun>
mcap::Bytes noun_json(const OpenTrace& trace,
                      const char* name,
                      const mcap::Bytes& bytes,
                      std::optional<std::string> (*fault_of)(mcap::View)) {
    if (const auto fault = fault_of(bytes))
        trace.file.fail(find_attachment(trace.index, name)->offset,
                        fmt::format("the attachment '{}' is damaged ({})", name, *fault));
    return to_bytes(to_json(*flatbuffers::GetRoot<Noun>(bytes.data())));
}

mcap::Bytes episode_json(const OpenTrace& trace) {
    const char* name = format::episode_attachment;
    return noun_json<world::Episode>(
        trace, name, read_attachment(trace.file, trace.index, name), fault_of_episode);
}

mcap::Bytes town_json(const OpenTrace& trace) {
    const char* name = format::town_attachment;
    return noun_json<world::Town>(
        trace, name, read_packed_attachment(trace.file, trace.index, name), fault_of_town);
}

mcap::Bytes metadata_json(const OpenTrace& trace) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const mcap::Metadata& entry : trace.index.metadata)
        if (const auto texts = read_metadata(trace.file, trace.index, entry.name))
            json[entry.name] = *texts;
    return to_bytes(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
                    "\n");
}

/// Schemas stand in front of the first chunk; they are few and small.
mcap::Bytes schema(const OpenTrace& trace, const std::string& name) {
    std::uint64_t at = mcap::magic.size();
    while (at + mcap::prefix_size <= trace.index.data_end) {
        const mcap::Bytes start = trace.file.read(at, mcap::prefix_size);
        mcap::Decoder prefix(start);
        const auto op = static_cast<mcap::Op>(prefix.number<std::uint8_t>());
        const auto length = prefix.number<std::uint64_t>();
        if (op == mcap::Op::chunk || length > trace.index.data_end - at - mcap::prefix_size)
            break;
        if (op == mcap::Op::schema) {
            const mcap::Bytes content = trace.file.read(at + mcap::prefix_size, length);
            mcap::Decoder record(content);
            record.number<std::uint16_t>();  // id
            if (record.text() == name) {
                record.text();  // encoding
                const mcap::View data = record.raw(record.number<std::uint32_t>());
                return {data.begin(), data.end()};
            }
        }
        at += mcap::prefix_size + length;
    }
    trace.file.fail(0, "the trace has no schema '" + name + "'");
}

constexpr Part parts[] = {
    {"scenario",
     [](const OpenTrace& trace) {
         return read_attachment(trace.file, trace.index, format::scenario_attachment);
     }},
    {"episode", episode_json},
    {"town", town_json},
    {"network",
     [](const OpenTrace& trace) {
         return read_packed_attachment(trace.file, trace.index, format::network_attachment);
     }},
    {"metadata", metadata_json},
    {"tick.bfbs", [](const OpenTrace& trace) { return schema(trace, "reprise.world.Tick"); }},
    {"traffic.bfbs", [](const OpenTrace& trace) { return schema(trace, "reprise.world.Traffic"); }},
};

}  // namespace

std::vector<std::string> part_names() {
    std::vector<std::string> names;
    for (const Part& part : parts)
        names.emplace_back(part.name);
    return names;
}

mcap::Bytes read_part(const std::filesystem::path& trace, const std::string& name) {
    const auto part = std::find_if(
        std::begin(parts), std::end(parts), [&](const Part& p) { return p.name == name; });
    if (part == std::end(parts))
        throw world::Error(fmt::format("no part '{}' of a trace{}; there are {}",
                                       name,
                                       world::did_you_mean(name, part_names()),
                                       fmt::join(part_names(), ", ")));
    const InputFile file(trace);
    std::optional<TraceIndex> index = read_index(file);
    if (!index)
        index = scan(file);  // cut off: what lies in front of the cut can still be read
    try {
        return part->read({file, *index});
    } catch (const mcap::Malformed& error) {
        file.fail(0, fmt::format("'{}' is damaged ({})", name, error.what()));
    }
}

}  // namespace reprise::replay

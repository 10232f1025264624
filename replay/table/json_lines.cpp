#include "replay/table/json_lines.h"

#include "replay/table/shape.h"
#include "world/check.h"

namespace reprise::replay {

using namespace reflection;

namespace {

/// Writes what is wanted of an object.
struct JsonWriter {
    std::string& out;
    std::optional<std::uint32_t> actor;

    void object(const std::vector<Shape>& members, Bytes object) {
        char before = '{';
        for (const Shape& part : members) {
            out += before;
            member(part, object);
            before = ',';
        }
        out += members.empty() ? "{}" : "}";
    }

    void member(const Shape& shape, Bytes object) {
        out.append("\"").append(shape.field.name).append("\":");
        const Bytes at = address(*shape.owner, object, shape.field);
        if (shape.field.repeating && at != nullptr)
            list(shape, elements_of(shape.field, at));
        else
            value(shape, at);
    }

    void value(const Shape& shape, Bytes at) {
        if (shape.field.type == flatbuffers::ET_SEQUENCE && at != nullptr)
            object(shape.members, is_table(shape.field) ? follow(at) : at);
        else
            append_json(value_at(shape.field, at), out);
    }

    void list(const Shape& shape, const Elements& elements) {
        out += '[';
        bool first = true;
        for (std::size_t i = 0; i < elements.count; ++i) {
            if (actor && !shape.actors.empty() && !belongs_to(shape, elements.at(i), *actor))
                continue;
            if (!first)
                out += ',';
            value(shape, elements.at(i));
            first = false;
        }
        out += ']';
    }
};

std::string noun_json(const flatbuffers::TypeTable& type, const void* noun) {
    std::vector<bool> used;
    std::string out;
    JsonWriter{out, {}}.object(shapes_of(type, {}, used), static_cast<Bytes>(noun));
    return out + "\n";
}

}  // namespace

std::string to_json(const world::Episode& episode) {
    return noun_json(*world::EpisodeTypeTable(), &episode);
}

std::string to_json(const world::Town& town) {
    return noun_json(*world::TownTypeTable(), &town);
}

struct JsonLines::Plan {
    std::vector<Shape> tick;
    std::vector<Shape> traffic;
    std::optional<std::uint32_t> actor;
    std::uint64_t step_ns;

    void line(const char* topic,
              const std::vector<Shape>& shapes,
              std::uint64_t index,
              const void* noun,
              std::string& out) const {
        if (shapes.empty() || noun == nullptr)
            return;
        out.append("{\"topic\":\"").append(topic).append("\",\"tick\":");
        append_json(Value(index), out);
        out += ",\"time\":";
        append_json(Value(static_cast<double>(index * step_ns) / 1e9), out);
        for (const Shape& shape : shapes) {
            out += ',';
            JsonWriter{out, actor}.member(shape, static_cast<Bytes>(noun));
        }
        out += "}\n";
    }
};

JsonLines::JsonLines(const Selection& selection, std::uint64_t step_ns)
    : plan_(std::make_unique<Plan>()) {
    std::vector<bool> used;
    plan_->tick = shapes_of(*world::TickTypeTable(), selection, used);
    plan_->traffic = shapes_of(*world::TrafficTypeTable(), selection, used);
    check_used(selection, used);
    plan_->actor = selection.actor;
    plan_->step_ns = step_ns;
    // The line begins with these.
    const auto index = [](const Shape& shape) {
        const std::string_view name = shape.field.name;
        return name == "index" || name == "tick";
    };
    std::erase_if(plan_->tick, index);
    std::erase_if(plan_->traffic, index);
}

JsonLines::~JsonLines() = default;

void JsonLines::append_tick(const RecordedTick& tick, std::string& out) const {
    plan_->line("/sim/tick", plan_->tick, tick.view.index(), tick.view.tick, out);
}

void JsonLines::append_traffic(const RecordedTick& tick, std::string& out) const {
    plan_->line("/sim/traffic", plan_->traffic, tick.view.index(), tick.view.traffic, out);
}

}  // namespace reprise::replay

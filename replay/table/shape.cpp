#include "replay/table/shape.h"

#include <algorithm>

#include <fmt/format.h>

#include "world/check.h"
#include "world/tick_generated.h"
#include "world/traffic_generated.h"

namespace reprise::replay {

namespace reflection {

namespace {

bool is_below(const std::string& path, const std::string& above) {
    return path.size() > above.size() && path.starts_with(above) && path[above.size()] == '.';
}

/// Chooses the fields of one noun, all the way down.
class Chooser {
  public:
    Chooser(const Selection& selection, std::vector<bool>& used)
        : selection_(selection),
          used_(used) {}

    std::vector<Shape> choose(const flatbuffers::TypeTable& type,
                              const std::string& prefix,
                              const std::vector<Field>& keys) {
        std::vector<Shape> shapes;
        for (const Field& field : fields_of(type)) {
            const std::string path = prefix + field.name;
            const bool key = find_field(keys, field.name) != nullptr;
            if (!wanted(path) && !key)
                continue;
            Shape shape{field, &type, {}, actors_of(field)};
            if (field.type == flatbuffers::ET_SEQUENCE)
                shape.members = choose(*field.ref, path + ".", key_of(field));
            shapes.push_back(std::move(shape));
        }
        return shapes;
    }

  private:
    bool wanted(const std::string& path) {
        bool found = selection_.fields.empty();
        for (std::size_t i = 0; i < selection_.fields.size(); ++i) {
            const std::string& field = selection_.fields[i];
            if (field == path)
                used_[i] = true;
            found |= field == path || is_below(field, path) || is_below(path, field);
        }
        return found;
    }

    static std::vector<Field> actors_of(const Field& field) {
        std::vector<Field> actors;
        if (field.type != flatbuffers::ET_SEQUENCE || !field.repeating)
            return actors;
        for (const Field& member : fields_of(*field.ref)) {
            const std::string_view name = member.name;
            const bool names =
                name == "id" || name == "actor" || name == "other" || name == "vehicle";
            if (names && member.type == flatbuffers::ET_UINT)
                actors.push_back(member);
        }
        return actors;
    }

    const Selection& selection_;
    std::vector<bool>& used_;
};

/// Every path that a selection may name.
void add_paths(const flatbuffers::TypeTable& type,
               const std::string& prefix,
               std::vector<std::string>& paths) {
    for (const Field& field : fields_of(type)) {
        paths.push_back(prefix + field.name);
        if (field.type == flatbuffers::ET_SEQUENCE)
            add_paths(*field.ref, prefix + field.name + ".", paths);
    }
}

}  // namespace

std::vector<Shape> shapes_of(const flatbuffers::TypeTable& type,
                             const Selection& selection,
                             std::vector<bool>& used) {
    used.resize(selection.fields.size(), false);
    std::vector<Shape> shapes = Chooser(selection, used).choose(type, "", {});
    if (selection.actor && selection.fields.empty())
        std::erase_if(shapes, [](const Shape& shape) { return shape.actors.empty(); });
    return shapes;
}

void check_used(const Selection& selection, const std::vector<bool>& used) {
    for (std::size_t i = 0; i < selection.fields.size(); ++i) {
        if (used[i])
            continue;
        std::vector<std::string> paths;
        add_paths(*world::TickTypeTable(), "", paths);
        add_paths(*world::TrafficTypeTable(), "", paths);
        std::string suggestion = world::did_you_mean(selection.fields[i], paths);
        if (suggestion.empty())
            suggestion = fmt::format("; there are {}", fmt::join(top_level_fields(), ", "));
        throw world::Error(fmt::format("no field '{}'{}", selection.fields[i], suggestion));
    }
}

bool belongs_to(const Shape& list, Bytes element, std::uint32_t actor) {
    const Bytes object = is_table(list.field) ? follow(element) : element;
    return std::any_of(list.actors.begin(), list.actors.end(), [&](const Field& field) {
        const Bytes value = address(*list.field.ref, object, field);
        return value != nullptr && flatbuffers::ReadScalar<std::uint32_t>(value) == actor;
    });
}

}  // namespace reflection

std::vector<std::string> top_level_fields() {
    std::vector<std::string> names;
    for (const flatbuffers::TypeTable* type : {world::TickTypeTable(), world::TrafficTypeTable()})
        for (const reflection::Field& field : reflection::fields_of(*type))
            names.emplace_back(field.name);
    return names;
}

}  // namespace reprise::replay

#include "replay/table/table.h"

#include <algorithm>

#include <fmt/format.h>

#include "replay/table/shape.h"
#include "world/check.h"

namespace reprise::replay {

using namespace reflection;

namespace {

constexpr const char* ticks_table = "ticks";

/// A column: the way from the row's object to one value.
struct Leaf {
    std::vector<const Shape*> way;  ///< structs and tables to go through, then the value's field
};

std::string column_name(const std::string& path) {
    std::string name = path;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

/// A list inside of a row, such as the lanes of a command: as JSON.
Value list_text(const Field& field, Bytes at) {
    const Elements elements = elements_of(field, at);
    std::string text = "[";
    for (std::size_t i = 0; i < elements.count; ++i) {
        text += i == 0 ? "" : ",";
        append_json(value_at(field, elements.at(i)), text);
    }
    return text + "]";
}

Value value_of(const Leaf& leaf, Bytes object) {
    for (const Shape* step : leaf.way) {
        const Bytes at = address(*step->owner, object, step->field);
        if (at == nullptr)
            return {};
        if (step->field.repeating)
            return list_text(step->field, at);
        if (step->field.type != flatbuffers::ET_SEQUENCE)
            return value_at(step->field, at);
        object = is_table(step->field) ? follow(at) : at;
    }
    return {};
}

/// A list of the ticks, and the noun that has it.
struct List {
    const flatbuffers::TypeTable* owner = nullptr;
    std::string field;
};

bool has_list(const flatbuffers::TypeTable& type, const std::string& name) {
    const std::vector<Field> fields = fields_of(type);
    const Field* field = find_field(fields, name);
    return field != nullptr && field->repeating;
}

/// The list that is this table; of no noun when there is none. Of two that have one name, the
/// traffic's is `traffic_` and the name.
List list_of(const std::string& table) {
    constexpr std::string_view prefix = "traffic_";
    if (has_list(*world::TickTypeTable(), table))
        return {world::TickTypeTable(), table};
    std::string field = table;
    if (table.starts_with(prefix) && has_list(*world::TickTypeTable(), table.substr(prefix.size())))
        field.erase(0, prefix.size());
    if (has_list(*world::TrafficTypeTable(), field))
        return {world::TrafficTypeTable(), field};
    return {};
}

bool is_index(const Shape& shape) {
    const std::string_view name = shape.field.name;
    return name == "index" || name == "tick";
}

}  // namespace

struct Table::Plan {
    std::string name;
    std::vector<Shape> shapes;  ///< the list, or of `ticks` the single fields
    bool of_ticks = false;
    bool of_traffic = false;
    std::optional<std::uint32_t> actor;
    std::uint64_t step_ns = 1;
    std::vector<std::string> columns{"tick", "time"};
    std::vector<Leaf> leaves;
    TableNames names;
    std::vector<Derived> derived;  ///< the last columns

    void add_leaves(const std::vector<Shape>& members,
                    const std::string& prefix,
                    std::vector<const Shape*> way) {
        for (const Shape& member : members) {
            if (std::string_view(member.field.name).starts_with("reserved"))
                continue;
            way.push_back(&member);
            const std::string path = prefix + member.field.name;
            if (member.field.type == flatbuffers::ET_SEQUENCE && !member.field.repeating) {
                add_leaves(member.members, path + ".", way);
            } else {
                columns.push_back(column_of_field(name, column_name(path)));
                leaves.push_back({way});
            }
            way.pop_back();
        }
    }

    /// Single numbers of a tick, and single structs.
    void plan_ticks(Selection selection) {
        std::erase(selection.fields, ticks_table);
        std::vector<bool> used;
        shapes = shapes_of(*world::TickTypeTable(), selection, used);
        std::erase_if(shapes, [](const Shape& s) { return s.field.repeating || is_index(s); });
        std::vector<bool> of_traffic_too = used;
        shapes_of(*world::TrafficTypeTable(), selection, of_traffic_too);
        check_used(selection, of_traffic_too);
        add_leaves(shapes, "", {});
    }

    void plan_list(const List& list, Selection selection) {
        of_traffic = list.owner == world::TrafficTypeTable();
        if (selection.fields.empty())
            selection.fields = {name};
        const bool is_whole = std::find(selection.fields.begin(), selection.fields.end(), name) !=
                              selection.fields.end();
        for (std::string& field : selection.fields)
            if (field == name || field.starts_with(name + "."))
                field.replace(0, name.size(), list.field);
        std::vector<bool> used;
        shapes = shapes_of(*list.owner, selection, used);
        check_used(selection, used);
        std::erase_if(shapes, [&](const Shape& s) { return s.field.name != list.field; });
        if (shapes.front().field.type == flatbuffers::ET_SEQUENCE) {
            add_leaves(shapes.front().members, "", {});
        } else {
            columns.insert(columns.end(), {"place", "value"});
        }
        derived = derived_columns(name, names, is_whole);
        for (const Derived& column : derived)
            columns.push_back(column.name);
    }

    void read_list(const RecordedTick& tick,
                   Bytes object,
                   std::vector<Value>& values,
                   const std::function<void(std::span<const Value>)>& row) const {
        const Shape& list = shapes.front();
        const Elements elements = elements_of(list.field, address(*list.owner, object, list.field));
        for (std::size_t i = 0; i < elements.count; ++i) {
            const Bytes element = elements.at(i);
            if (actor && !belongs_to(list, element, *actor))
                continue;
            if (leaves.empty()) {
                values[2] = static_cast<std::int64_t>(i);
                values[3] = value_at(list.field, element);
            } else {
                const Bytes members = is_table(list.field) ? follow(element) : element;
                for (std::size_t c = 0; c < leaves.size(); ++c)
                    values[2 + c] = value_of(leaves[c], members);
                for (std::size_t c = 0; c < derived.size(); ++c)
                    values[2 + leaves.size() + c] = derived[c].value(names, tick, members);
            }
            row(values);
        }
    }
};

std::vector<std::string> Table::names() {
    std::vector<std::string> names{ticks_table};
    for (const flatbuffers::TypeTable* type : {world::TickTypeTable(), world::TrafficTypeTable()})
        for (const Field& field : fields_of(*type)) {
            const bool taken = std::find(names.begin(), names.end(), field.name) != names.end();
            if (field.repeating)
                names.push_back((taken ? "traffic_" : "") + std::string(field.name));
        }
    return names;
}

bool Table::is_of_traffic(const std::string& name) {
    return list_of(name).owner == world::TrafficTypeTable();
}

bool Table::has_actors(const std::string& name) {
    const List list = list_of(name);
    if (list.owner == nullptr)
        return false;
    std::vector<bool> used;
    const std::vector<Shape> shapes = shapes_of(*list.owner, {{list.field}, {}}, used);
    return std::any_of(shapes.begin(), shapes.end(), [&](const Shape& shape) {
        return shape.field.name == list.field && !shape.actors.empty();
    });
}

Table::Table(const std::string& name,
             const Selection& selection,
             std::uint64_t step_ns,
             const TableNames& names)
    : plan_(std::make_unique<Plan>()) {
    plan_->name = name;
    plan_->names = names;
    plan_->actor = selection.actor;
    plan_->step_ns = step_ns;
    plan_->of_ticks = name == ticks_table;
    if (plan_->of_ticks) {
        if (selection.actor)
            throw world::Error("the table 'ticks' has no actors");
        plan_->plan_ticks(selection);
        return;
    }
    const List list = list_of(name);
    if (list.owner == nullptr)
        throw world::Error(fmt::format("no table '{}'{}; there are {}",
                                       name,
                                       world::did_you_mean(name, Table::names()),
                                       fmt::join(Table::names(), ", ")));
    plan_->plan_list(list, selection);
}

Table::~Table() = default;
Table::Table(Table&&) noexcept = default;
Table& Table::operator=(Table&&) noexcept = default;

const std::string& Table::name() const {
    return plan_->name;
}

const std::vector<std::string>& Table::columns() const {
    return plan_->columns;
}

void Table::read(const RecordedTick& tick,
                 const std::function<void(std::span<const Value>)>& row) const {
    const std::uint64_t index = tick.view.index();
    const void* noun = plan_->of_traffic ? static_cast<const void*>(tick.view.traffic)
                                         : static_cast<const void*>(tick.view.tick);
    if (noun == nullptr)
        return;
    std::vector<Value> values(plan_->columns.size());
    values[0] = index;
    values[1] = static_cast<double>(index * plan_->step_ns) / 1e9;
    if (!plan_->of_ticks) {
        plan_->read_list(tick, static_cast<Bytes>(noun), values, row);
        return;
    }
    for (std::size_t c = 0; c < plan_->leaves.size(); ++c)
        values[2 + c] = value_of(plan_->leaves[c], static_cast<Bytes>(noun));
    row(values);
}

std::string table_of(const Selection& selection) {
    std::string table;
    for (const std::string& field : selection.fields) {
        const std::string first = field.substr(0, field.find('.'));
        const std::string name = list_of(first).owner != nullptr ? first : ticks_table;
        if (!table.empty() && table != name)
            throw world::Error(
                fmt::format("a CSV file holds one table, and '{}' is of '{}', not of '{}'; choose "
                            "fields of one, or use jsonl",
                            field,
                            name,
                            table));
        table = name;
    }
    if (table.empty())
        throw world::Error(fmt::format("a CSV file holds one table; choose it by --fields: {}",
                                       fmt::join(Table::names(), ", ")));
    return table;
}

void append_csv_header(const Table& table, std::string& out) {
    for (const std::string& column : table.columns())
        out += (&column == &table.columns().front() ? "" : ",") + with_unit(column);
    out += '\n';
}

void append_csv(const Table& table, const RecordedTick& tick, std::string& out) {
    table.read(tick, [&](std::span<const Value> values) {
        for (const Value& value : values) {
            if (&value != values.data())
                out += ',';
            append_csv(value, out);
        }
        out += '\n';
    });
}

}  // namespace reprise::replay

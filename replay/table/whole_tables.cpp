#include "replay/table/whole_tables.h"

#include <map>
#include <optional>
#include <span>

#include "replay/table/derived.h"
#include "world/models/catalogue.h"
#include "world/recording.h"

namespace reprise::replay {

namespace {

struct TableActor {
    std::string name;
    const char* kind = nullptr;  ///< null: not seen yet
    std::uint16_t model = 0;
    std::optional<double> spawned;  ///< [s]
    std::optional<double> despawned;
    std::optional<double> wrecked;  ///< [s] a car until then, a vehicle from there on
};

using TableActors = std::map<std::uint32_t, TableActor>;

template <typename State>
void note_states(std::span<const State> states, const char* kind, TableActors& actors) {
    for (const State& state : states) {
        TableActor& actor = actors[state.id()];
        if (actor.kind == nullptr) {
            actor.kind = kind;
            actor.model = state.model();
        }
    }
}

void note_events(const world::TickView& tick, double time, TableActors& actors) {
    if (tick.tick->events() == nullptr)
        return;
    for (const world::Event* event : *tick.tick->events()) {
        if (event->kind() == world::EventKind::spawned) {
            TableActor& actor = actors[event->actor()];
            actor.spawned = time;
            if (event->text() != nullptr && event->actor() < world::first_background_id)
                actor.name = event->text()->str();
        }
        if (event->kind() == world::EventKind::despawned)
            actors[event->actor()].despawned = time;
        if (event->kind() == world::EventKind::wrecked)
            actors[event->actor()].wrecked = time;
    }
}

std::vector<Value> row_of(std::uint32_t id, const TableActor& actor) {
    const auto time = [](const std::optional<double>& at) { return at ? Value(*at) : Value(); };
    const std::string kind = actor.wrecked ? "vehicle" : actor.kind == nullptr ? "" : actor.kind;
    std::vector<Value> row{std::int64_t{id},
                           actor.name.empty() ? Value() : Value(actor.name),
                           kind.empty() ? Value() : Value(kind)};
    const auto vehicles = world::vehicle_models();
    const auto walkers = world::walker_models();
    if ((kind == "vehicle" || kind == "car") && actor.model < vehicles.size()) {
        const world::VehicleModel& model = vehicles[actor.model];
        row.insert(row.end(), {std::string(model.name), model.length, model.width, model.height});
    } else if (kind == "walker" && actor.model < walkers.size()) {
        const world::WalkerModel& model = walkers[actor.model];
        row.insert(row.end(), {std::string(model.name), {}, model.shoulder_width, model.height});
    } else {
        row.insert(row.end(), 4, Value());
    }
    row.insert(row.end(), {time(actor.spawned), time(actor.despawned), time(actor.wrecked)});
    return row;
}

}  // namespace

const std::vector<std::string>& whole_table_names() {
    static const std::vector<std::string> names{"lanes", "actors"};
    return names;
}

WholeTable read_whole_table(TraceReader& trace, const std::string& name) {
    return name == "lanes" ? lanes_table(trace.recording().town) : actors_table(trace);
}

WholeTable lanes_table(const world::TownT& town) {
    WholeTable table{"lanes",
                     {"number",
                      "name",
                      "edge",
                      "index",
                      "kind",
                      "length",
                      "width",
                      "speed_limit",
                      "left",
                      "right",
                      "opposite",
                      "junction",
                      "street",
                      "road",
                      "road_lane",
                      "road_s",
                      "road_s_end"},
                     {}};
    const auto name_of = [](const auto& items, std::uint32_t index) {
        return index < items.size() ? Value(items[index].name) : Value();
    };
    const auto text = [](const std::string& said) { return said.empty() ? Value() : Value(said); };
    for (std::size_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        const bool has_road = !lane.road.empty();
        table.rows.push_back({static_cast<std::int64_t>(i),
                              lane.name,
                              lane.edge,
                              std::int64_t{lane.index},
                              std::string(world::EnumNameLaneKind(lane.kind)),
                              lane.length,
                              lane.width,
                              lane.speed_limit,
                              name_of(town.lanes, lane.left),
                              name_of(town.lanes, lane.right),
                              name_of(town.lanes, lane.opposite),
                              name_of(town.junctions, lane.junction),
                              text(lane.street),
                              text(lane.road),
                              has_road ? Value(std::int64_t{lane.road_lane}) : Value(),
                              has_road ? Value(lane.road_s) : Value(),
                              has_road ? Value(lane.road_s_end) : Value()});
    }
    return table;
}

WholeTable actors_table(TraceReader& trace) {
    TableActors actors;
    const std::uint64_t step_ns = trace.episode().step_ns;
    for (std::uint64_t index = trace.first(); index <= trace.last(); ++index) {
        const world::TickView tick = trace.recorded(index).view;
        note_events(tick, world::seconds(index, step_ns), actors);
        note_states(tick.vehicles(), "vehicle", actors);
        note_states(tick.props(), "prop", actors);
        if (tick.traffic == nullptr)
            continue;
        note_states(tick.cars(), "car", actors);
        note_states(tick.walkers(), "walker", actors);
    }
    WholeTable table{"actors",
                     {"id",
                      "name",
                      "kind",
                      "model",
                      "length",
                      "width",
                      "height",
                      "spawned",
                      "despawned",
                      "wrecked"},
                     {}};
    for (const auto& [id, actor] : actors)
        table.rows.push_back(row_of(id, actor));
    return table;
}

std::string to_csv(const WholeTable& table) {
    std::string out;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        out += (i == 0 ? "" : ",") + with_unit(table.columns[i]);
    out += '\n';
    for (const auto& row : table.rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            out += i == 0 ? "" : ",";
            append_csv(row[i], out);
        }
        out += '\n';
    }
    return out;
}

}  // namespace reprise::replay

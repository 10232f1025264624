#include "replay/score/score.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "replay/score/watch.h"
#include "replay/table/kept.h"
#include "world/lanes/route_progress.h"
#include "world/story/crashes.h"

namespace reprise::replay {

namespace {

/// ActorBlockedTest of CARLA's scenario runner, as the Leaderboard asks for it: 0.1 m/s, 180 s.
constexpr double longest_stand = 180;  // [s]

/// A vehicle while the trace is read.
struct Scored {
    VehicleScore result;
    std::vector<std::unique_ptr<Watch>> watches;
    LastSeen seen;
    std::uint32_t lane = world::none;  ///< in the tick before: what the scenario saw
    double lane_s = 0;
    bool keeps_lane = false;
    std::optional<world::RouteProgress> progress;
};

class Scorer {
  public:
    Scorer(const world::TownT& town, double step, std::optional<std::uint32_t> actor)
        : town_(town),
          step_(step),
          actor_(actor) {}

    /// A slice's: who was there before.
    void know(const world::Spawns& spawns) {
        spawns_ = spawns;
        for (const auto& [id, spawn] : spawns)
            names_.know(id, spawn.command.text);
    }

    void look(const world::TickView& tick) {
        names_.hear(tick);
        hear_spawns(*tick.tick, spawns_);
        for (const world::VehicleState& vehicle : tick.vehicles()) {
            const world::Measurement* measured = world::find(tick.measurements(), vehicle.id());
            if ((actor_ && vehicle.id() != *actor_) || measured == nullptr ||
                !is_driven(spawns_, vehicle.id()) ||
                vehicle.model() >= world::vehicle_models().size())
                continue;
            look(tick, vehicle, *measured);
        }
    }

    std::vector<VehicleScore> finish() {
        std::vector<VehicleScore> all;
        for (auto& [id, scored] : scored_) {
            for (const auto& watch : scored.watches) {
                watch->finish();
                take(*watch, scored.result);
            }
            if (scored.progress)
                scored.result.route->completion = scored.progress->share();
            std::stable_sort(scored.result.infractions.begin(),
                             scored.result.infractions.end(),
                             [](const Infraction& one, const Infraction& other) {
                                 return std::pair(one.first, one.kind) <
                                        std::pair(other.first, other.kind);
                             });
            if (const std::string* name = names_.given(id))
                scored.result.name = *name;
            all.push_back(std::move(scored.result));
        }
        return all;
    }

  private:
    static void take(Watch& watch, VehicleScore& result) {
        for (const Infraction& infraction : watch.take())
            result.infractions.push_back(infraction);
    }

    void look(const world::TickView& tick,
              const world::VehicleState& vehicle,
              const world::Measurement& measured) {
        const auto [found, is_new] = scored_.try_emplace(vehicle.id());
        Scored& scored = found->second;
        const Sight sight = see(tick, vehicle, measured, step_, scored.seen);
        if (is_new) {
            scored.watches = all_watches(town_);
            scored.result.id = vehicle.id();
            scored.result.model = sight.model.name;
            scored.lane = measured.lane();
            scored.lane_s = measured.lane_s();
        }
        hear_commands(sight, scored);
        follow_route(sight, scored);
        for (const auto& watch : scored.watches) {
            watch->look(sight);
            take(*watch, scored.result);
        }
        VehicleScore& result = scored.result;
        ++result.ticks;
        result.driven += sight.driven;
        result.off_lane += is_off_lane(sight) ? sight.driven : 0;
        if (!result.ended && static_cast<double>(measured.halted_ticks()) * step_ > longest_stand)
            result.ended = {sight.index(), result.driven, result.off_lane};
        scored.lane = measured.lane();
        scored.lane_s = measured.lane_s();
    }

    void hear_commands(const Sight& sight, Scored& scored) {
        if (sight.tick.tick->commands() == nullptr)
            return;
        for (const world::Command* command : *sight.tick.tick->commands()) {
            if (command->actor() != sight.vehicle.id())
                continue;
            const auto* lanes = command->lanes();
            if (command->kind() == world::CommandKind::change_lane)
                scored.keeps_lane =
                    lanes != nullptr && lanes->size() == 1 && lanes->Get(0) == world::none;
            if (command->kind() != world::CommandKind::set_route || lanes == nullptr)
                continue;
            const std::vector<std::uint32_t> stops(lanes->begin(), lanes->end());
            plan(sight.index(), stops, command->s(), scored);
        }
    }

    /// From where the scenario saw it when it said so.
    void plan(std::uint64_t tick,
              const std::vector<std::uint32_t>& stops,
              double last_s,
              Scored& scored) const {
        scored.progress.reset();
        scored.result.route.reset();
        const auto& lanes = town_.town.lanes;
        const auto is_way = [&](std::uint32_t lane) {
            return lane < lanes.size() && world::is_for_cars(lanes[lane]);
        };
        if (!is_way(scored.lane) || stops.empty() ||
            !std::all_of(stops.begin(), stops.end(), is_way))
            return;
        const auto changes =
            scored.keeps_lane ? world::LaneChanges::forbidden : world::LaneChanges::allowed;
        auto route = world::plan_over(
            world::Planner(town_.town, changes), {scored.lane, scored.lane_s}, stops, last_s);
        if (!route)
            return;
        scored.result.route = RouteScore{route->length, 0, tick, 0};
        scored.progress.emplace(std::move(*route));
    }

    void follow_route(const Sight& sight, Scored& scored) const {
        if (!scored.progress || scored.result.ended)
            return;
        std::optional<world::LanePlace> place;
        if (sight.measured.lane() < town_.town.lanes.size())
            place = {sight.measured.lane(), sight.measured.lane_s()};
        scored.progress->drive_on(town_.town, place, sight.driven, sight.front());
        if (scored.progress->share() >= 1 && scored.result.route->arrived_at == 0)
            scored.result.route->arrived_at = sight.index();
    }

    DrivenTown town_;
    double step_;
    std::optional<std::uint32_t> actor_;
    world::ActorNames names_;
    world::Spawns spawns_;
    std::map<std::uint32_t, Scored> scored_;
};

}  // namespace

double RouteScore::counted() const {
    // RouteCompletionTest of CARLA's scenario runner.
    constexpr double whole = 0.99;
    constexpr double near = 10;  // [m]
    return completion >= whole && (1 - completion) * length <= near ? 1 : completion;
}

std::uint64_t VehicleScore::count(InfractionKind kind, std::uint64_t step_ns) const {
    std::uint64_t sum = 0;
    for (const Infraction& infraction : infractions)
        sum += infraction.kind == kind ? count_of(infraction, step_ns) : 0;
    return sum;
}

std::uint64_t VehicleScore::episodes(InfractionKind kind) const {
    return static_cast<std::uint64_t>(
        std::count_if(infractions.begin(), infractions.end(), [&](const Infraction& infraction) {
            return infraction.kind == kind;
        }));
}

const Infraction* VehicleScore::worst(InfractionKind kind) const {
    const Infraction* found = nullptr;
    for (const Infraction& infraction : infractions)
        if (infraction.kind == kind && (found == nullptr || infraction.worst > found->worst))
            found = &infraction;
    return found;
}

std::vector<VehicleScore> score(TraceReader& trace, std::optional<std::uint32_t> actor) {
    require_kept(trace, "vehicles");
    Scorer scorer(
        trace.recording().town, static_cast<double>(trace.episode().step_ns) * 1e-9, actor);
    if (const auto slice = trace.slice())
        scorer.know(slice->spawns);
    for (std::uint64_t index = trace.first(); index <= trace.last(); ++index)
        scorer.look(trace.recorded(index).view);
    return scorer.finish();
}

}  // namespace reprise::replay

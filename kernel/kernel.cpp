#include "kernel/kernel.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "ground/mesh/build_ground.h"
#include "ground/obstacles.h"
#include "kernel/blockages.h"
#include "kernel/car_hits.h"
#include "kernel/digests.h"
#include "kernel/doors.h"
#include "kernel/goals.h"
#include "kernel/infractions.h"
#include "kernel/lamp_orders.h"
#include "kernel/measurements.h"
#include "kernel/nudger.h"
#include "kernel/pedestrians.h"
#include "kernel/physics/physics.h"
#include "kernel/prop_orders.h"
#include "kernel/roster.h"
#include "kernel/side_thread.h"
#include "replay/chain_seed.h"
#include "scripting/scenario.h"
#include "traffic/background.h"
#include "world/arithmetic.h"
#include "world/check.h"
#include "world/recording.h"
#include "world/town.h"

namespace reprise::kernel {

namespace {

/// What is before the first tick: an empty world under the episode's weather.
world::SealedTick genesis(const world::EpisodeT& episode, const world::Digest128& chain_seed) {
    world::TickDraft draft;
    draft.tick.weather = episode.weather;
    draft.tick.road_friction = episode.road_friction;
    world::SealedTick sealed = world::seal(draft, chain_seed);
    return sealed;
}

/// The next tick before its first stage: weather and friction stay as they are until told else.
world::TickDraft draft_after(const world::TickView& last) {
    world::TickDraft next;
    next.tick.index = last.index() + 1;
    next.tick.weather = *last.tick->weather();
    next.tick.road_friction = last.tick->road_friction();
    return next;
}

void add(walkers::OnFoot on_foot, world::TickDraft& next) {
    next.traffic.walkers = std::move(on_foot.walkers);
    std::move(on_foot.events.begin(), on_foot.events.end(), std::back_inserter(next.tick.events));
}

}  // namespace

struct Kernel::Parts {
    Parts(const world::Recording& its_recording, const SolidGround* made)
        : recording(its_recording),
          episode(recording.episode),
          town(recording.town),
          ground(made != nullptr ? made : &own_ground.emplace(ground::build_ground(town))),
          lanes(town),
          scenario(episode, town, lanes),
          obstacles(ground::obstacles_of(town)),
          roster(episode, town, lanes, obstacles),
          background(episode, town, lanes, recording.network),
          pedestrians(episode, town, lanes, ground->mesh()),
          physics(episode, *ground, obstacles),
          continued(replay::chain_seed(recording)),
          last(genesis(episode, continued)),
          goals(town),
          infractions(town, world::seconds(1, episode.step_ns)),
          nudger(roster, pedestrians, physics) {}

    const world::Recording& recording;
    world::EpisodeT episode;  ///< of it script, parameters and limit change where a run branches
    const world::TownT& town;
    std::optional<SolidGround> own_ground;  ///< where nobody made it before
    const SolidGround* ground;
    world::LaneMap lanes;  ///< the run's only one
    scripting::Scenario scenario;
    std::vector<world::Obstacle> obstacles;
    Roster roster;
    traffic::Background background;
    Pedestrians pedestrians;
    SideThread side_thread;
    Physics physics;
    LampOrders lamps;
    Doors doors;
    world::Digest128 continued;  ///< the chain that the next tick goes on with
    world::SealedTick last;
    Goals goals;
    Infractions infractions;
    Nudger nudger;
    std::optional<world::TickDraft> next;    ///< begun, and waiting for controls
    std::exception_ptr fault;                ///< why it could not be begun
    std::vector<world::CheckResult> checks;  ///< before it was begun
    bool ends = false;                       ///< with the tick that is made or was made last
    std::string reason;
};

Kernel::Kernel(const world::Recording& recording, const SolidGround* ground)
    : parts_(std::make_unique<Parts>(recording, ground)) {}

Kernel::~Kernel() = default;

/// Advances the world by one fixed step. The whole simulation is begin() and this: every stage
/// reads the last tick, which no longer changes, and adds its part to the next one.
const world::SealedTick& Kernel::step(std::span<const world::Control> controls) {
    Parts& parts = *parts_;
    if (parts.fault)
        std::rethrow_exception(parts.fault);
    if (!parts.next) {
        parts.side_thread.stay_awake(true);
        begin();
    }
    const world::TickView last = parts.last.view();
    world::TickDraft& next = *parts.next;

    // 4. controls: what the drivers want
    parts.roster.apply_controls(controls, last, next);
    close(Stage::controls, next);

    // 5. physics: everything with mass, in equal substeps
    parts.doors.swing(world::seconds(1, parts.episode.step_ns), next);
    parts.physics.advance(last, next);
    parts.roster.take_over(parts.physics.wrecks(), next);
    parts.roster.end_trajectories(parts.physics.derailed());
    parts.lamps.light_vehicles(next);
    close(Stage::physics, next);

    // 6. measurements: lanes, gaps, footprints, impulses, goals, who is blocked or does wrong; in
    // the last tick the checks' verdicts
    const std::uint64_t step_ns = parts.episode.step_ns;
    measure(
        parts.town, parts.lanes, world::seconds(1, step_ns), parts.physics.impacts(), last, next);
    parts.goals.note(last, next);
    note_hit_walkers(world::seconds(1, step_ns), last, next);
    const auto is_under_way = [&](const auto& vehicle) {
        return parts.roster.is_under_way(vehicle);
    };
    note_blockages(parts.town, step_ns, is_under_way, last, next);
    parts.infractions.note(last, next);
    if (parts.ends)
        parts.scenario.conclude(last, next);
    close(Stage::measurements, next);

    // 7. record: from here on the tick never changes
    record(next);
    parts.next.reset();
    return parts.last;
}

/// The stages that look at no control of their tick.
void Kernel::begin() {
    Parts& parts = *parts_;
    const world::TickView last = parts.last.view();
    REPRISE_CHECK(!finished(), "step after the end, at tick " + std::to_string(last.index()));
    take_branch(last.index());
    world::TickDraft next = draft_after(last);

    // 1. scenario: what should happen
    parts.scenario.advance(last, next);
    parts.roster.apply_commands(last, next, parts.physics);
    place_props(parts.town, next, parts.physics);
    parts.lamps.apply_commands(next);
    parts.doors.apply_commands(next);
    note_outcome(next);
    close(Stage::scenario, next);

    // 2. and 3. traffic: background cars and signals; pedestrians
    walkers::OnFoot on_foot = drive_and_walk(last, next);
    look_ahead(next.tick.index + 1);
    parts.lamps.light_cars(next);
    close(Stage::traffic, next);
    add(std::move(on_foot), next);
    close(Stage::pedestrians, next);
    parts.next = std::move(next);
}

/// Neither traffic nor those on foot read what the other does in this tick, nor do the drivers,
/// whose turn comes later: a second processor makes what it can meanwhile. What is returned goes
/// into the tick behind what traffic wrote there.
walkers::OnFoot Kernel::drive_and_walk(const world::TickView& last, world::TickDraft& next) {
    Parts& parts = *parts_;
    parts.side_thread.drop();
    const std::span<const world::CommandT> commands = next.tick.commands;
    const std::uint64_t tick = next.tick.index;
    walkers::OnFoot on_foot;
    const auto walk = [&] {
        on_foot = parts.pedestrians.advance(last, commands);
        parts.roster.decide(last, tick);
    };
    const auto drive = [&](const traffic::Background::Both& both) {
        parts.background.advance(last, next, both);
    };
    if (parts.pedestrians.are_many()) {
        parts.side_thread.both([&] { drive(traffic::Background::in_turn); }, walk);
    } else if (parts.background.are_many()) {
        bool walked = false;
        drive([&](const auto& here, const auto& elsewhere) {
            parts.side_thread.both(here, [&] {
                elsewhere();
                if (!std::exchange(walked, true))  // behind the first
                    walk();
            });
        });
    } else {
        drive(traffic::Background::in_turn);
        walk();
    }
    return on_foot;
}

/// Traffic's cars are as they are until they make their next step: whom they meet then another
/// processor works out while this one makes the other stages. Where nobody walks it does so while
/// SUMO makes its step: there its thread would have to be woken for this alone once more.
void Kernel::look_ahead(std::uint64_t tick) {
    Parts& parts = *parts_;
    if (!parts.pedestrians.are_many() || !parts.background.are_many())
        return;
    parts.side_thread.offer([&background = parts.background, tick] {
        try {
            background.look_ahead(tick);
        } catch (...) {  // whoever makes the step hears of it
        }
    });
}

void Kernel::begin_step() {
    Parts& parts = *parts_;
    if (parts.next || parts.fault)
        return;
    parts.checks = parts.scenario.checks();
    parts.side_thread.stay_awake(false);  // drivers in other programs are about to think
    try {
        begin();
    } catch (...) {  // whoever asks for the step hears of it
        parts.fault = std::current_exception();
    }
}

/// Ends a stage: a drill may move a number in what it wrote, then its digest is taken.
void Kernel::close(Stage stage, world::TickDraft& next) {
    Parts& parts = *parts_;
    parts.nudger.after(stage, next);
    world::Digests& digests = next.tick.digests;
    switch (stage) {
        case Stage::scenario:
            return digests.mutate_scenario(digest_of(parts.scenario, next));
        case Stage::controls:
            return digests.mutate_controls(digest_of(parts.roster, parts.lamps, parts.doors, next));
        case Stage::traffic:
            return digests.mutate_traffic(digest_of(parts.background, next));
        case Stage::pedestrians:
            return digests.mutate_pedestrians(digest_of(parts.pedestrians, next));
        case Stage::physics:
            return digests.mutate_physics(digest_of(parts.physics, next));
        case Stage::measurements:
            return digests.mutate_measurements(digest_of_measurements(next));
    }
}

/// Seals the draft as the last tick.
void Kernel::record(world::TickDraft& next) {
    Parts& parts = *parts_;
    REPRISE_CHECK(world::is_plain_arithmetic(),
                  "tick " + std::to_string(next.tick.index) +
                      ": a library left the floating-point " +
                      "unit in another mode: " + world::unusual_arithmetic());
    parts.last = world::seal(next, parts.continued);
    parts.continued = parts.last.view().tick->digests()->chain();
}

/// The branch that the recording names behind this tick, if it does.
void Kernel::take_branch(std::uint64_t tick) {
    for (const world::BranchT& branch : parts_->recording.episode.branches)
        if (branch.tick == tick)
            this->branch(branch);
}

void Kernel::branch(const world::BranchT& branch) {
    Parts& parts = *parts_;
    REPRISE_CHECK(branch.tick == parts.last.view().index() && !parts.next && !parts.ends,
                  "a branch of tick " + std::to_string(branch.tick) + " at tick " +
                      std::to_string(parts.last.view().index()));
    parts.continued = replay::chain_of_branch(parts.continued, branch);
    parts.episode.max_ticks = branch.max_ticks;
    if (branch.scenario.empty()) {
        parts.scenario.change(branch.parameters);
        return;
    }
    parts.episode.name = branch.name;
    parts.episode.scenario = branch.scenario;
    parts.episode.scenario_path = branch.scenario_path;
    parts.episode.parameters = branch.parameters;
    parts.episode.files = branch.files;
    parts.scenario.take_over();
}

/// Commands that are about the whole run: the end, and the weather.
void Kernel::note_outcome(world::TickDraft& next) {
    Parts& parts = *parts_;
    for (const world::CommandT& command : next.tick.commands) {
        if (command.kind == world::CommandKind::set_weather) {
            next.tick.weather = command.weather;
            next.tick.road_friction = command.road_friction;
        }
        if (command.kind == world::CommandKind::finish && !parts.ends) {
            parts.ends = true;
            parts.reason = command.text.empty() ? "finished" : command.text;
        }
    }
    if (!parts.ends && next.tick.index >= parts.episode.max_ticks) {
        parts.ends = true;
        parts.reason = "time limit";
    }
    if (parts.ends) {
        world::EventT event;
        event.kind = world::EventKind::finished;
        event.text = parts.reason;
        next.tick.events.push_back(event);
    }
}

void Kernel::rest() {
    parts_->side_thread.rest();
}

bool Kernel::finished() const {
    return parts_->ends && !parts_->next;
}

world::Outcome Kernel::outcome() const {
    using Status = world::CheckResult::Status;
    const auto all = checks();
    bool failed = false;
    for (const auto& check : all)
        failed = failed || check.status != Status::pass;
    const std::string verdict = all.empty() ? "completed" : failed ? "failed" : "passed";
    return {verdict, finished() ? parts_->reason : "", parts_->last.view().index()};
}

std::vector<world::CheckResult> Kernel::checks() const {
    const bool begun = parts_->next || parts_->fault;
    return begun ? parts_->checks : parts_->scenario.checks();
}

void Kernel::nudge(const Nudge& nudge) {
    parts_->nudger.plan(nudge);
}

}  // namespace reprise::kernel

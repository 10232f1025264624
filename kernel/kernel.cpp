#include "kernel/kernel.h"

#include "ground/mesh/ground.h"
#include "ground/obstacles.h"
#include "kernel/digests.h"
#include "kernel/measurements.h"
#include "kernel/nudger.h"
#include "kernel/pedestrians.h"
#include "kernel/physics/physics.h"
#include "kernel/roster.h"
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

}  // namespace

struct Kernel::Stages {
    explicit Stages(const world::Recording& its_recording)
        : recording(its_recording),
          episode(recording.episode),
          town(recording.town),
          lanes(town),
          scenario(episode, town, lanes),
          obstacles(ground::obstacles_of(town)),
          roster(episode, town, lanes, obstacles),
          background(episode, town, lanes, recording.network),
          pedestrians(episode, town, lanes),
          physics(episode, ground::build_ground(town), obstacles),
          chain_seed(replay::chain_seed(recording)),
          last(genesis(episode, chain_seed)) {}

    const world::Recording& recording;
    world::EpisodeT episode;  ///< of it script, parameters and limit change where a run branches
    const world::TownT& town;
    world::LaneMap lanes;  ///< the run's only one
    scripting::Scenario scenario;
    std::vector<world::Obstacle> obstacles;
    Roster roster;
    traffic::Background background;
    Pedestrians pedestrians;
    Physics physics;
    world::Digest128 chain_seed;
    world::SealedTick last;
    Nudger nudger;
    bool finished = false;
    std::string reason;
};

Kernel::Kernel(const world::Recording& recording) : stages_(std::make_unique<Stages>(recording)) {}

Kernel::~Kernel() = default;

/// Advances the world by one fixed step. The whole simulation is this function: every stage reads
/// the last tick, which no longer changes, and adds its part to the next one.
const world::SealedTick& Kernel::step(std::span<const world::Control> controls) {
    Stages& stage = *stages_;
    const world::TickView last = stage.last.view();
    REPRISE_CHECK(!stage.finished, "step after the end, at tick " + std::to_string(last.index()));
    take_branch(last.index());
    world::TickDraft next;
    world::Digests& digests = next.tick.digests;
    next.tick.index = last.index() + 1;
    next.tick.weather = *last.tick->weather();
    next.tick.road_friction = last.tick->road_friction();

    // 1. scenario: what should happen
    stage.scenario.advance(last, next);
    stage.roster.apply_commands(last, next, stage.physics);
    note_outcome(next);
    stage.nudger.after_scenario(next);
    digests.mutate_scenario(digest_of(stage.scenario, next));

    // 2. controls: what the drivers want
    stage.roster.apply_controls(controls, last, next);
    stage.nudger.after_controls(next, stage.roster);
    digests.mutate_controls(digest_of(stage.roster, next));

    // 3. traffic: background cars and signals
    stage.background.advance(last, next);
    stage.nudger.after_traffic(next);
    digests.mutate_traffic(digest_of(stage.background, next));

    // 4. pedestrians
    stage.pedestrians.advance(last, next);
    stage.nudger.after_pedestrians(next, stage.pedestrians);
    digests.mutate_pedestrians(digest_of(stage.pedestrians, next));

    // 5. physics: everything with mass, in equal substeps
    stage.physics.advance(last, next);
    stage.nudger.after_physics(next, stage.physics);
    digests.mutate_physics(digest_of(stage.physics, next));

    // 6. measurements: lanes, gaps, footprints, impulses; in the last tick the checks' verdicts
    const double step_seconds = static_cast<double>(stage.episode.step_ns) * 1e-9;
    measure(stage.town, stage.lanes, step_seconds, last, next);
    if (stage.finished)
        stage.scenario.conclude(last, next);
    stage.nudger.after_measurements(next);
    digests.mutate_measurements(digest_of_measurements(next));

    // 7. record: from here on the tick never changes
    REPRISE_CHECK(world::is_plain_arithmetic(),
                  "tick " + std::to_string(next.tick.index) +
                      ": a library left the floating-point " +
                      "unit in another mode: " + world::unusual_arithmetic());
    stage.last =
        world::seal(next, last.index() == 0 ? stage.chain_seed : last.tick->digests()->chain());
    return stage.last;
}

/// The branch that the recording names behind this tick, if it does.
void Kernel::take_branch(std::uint64_t tick) {
    for (const world::BranchT& branch : stages_->recording.episode.branches)
        if (branch.tick == tick)
            this->branch(branch);
}

void Kernel::branch(const world::BranchT& branch) {
    Stages& stage = *stages_;
    REPRISE_CHECK(branch.tick == stage.last.view().index() && !stage.finished,
                  "a branch of tick " + std::to_string(branch.tick) + " at tick " +
                      std::to_string(stage.last.view().index()));
    stage.episode.max_ticks = branch.max_ticks;
    if (branch.scenario.empty()) {
        stage.scenario.change(branch.parameters);
        return;
    }
    stage.episode.name = branch.name;
    stage.episode.scenario = branch.scenario;
    stage.episode.scenario_path = branch.scenario_path;
    stage.episode.parameters = branch.parameters;
    stage.scenario.take_over();
}

/// Commands that are about the whole run: the end, and the weather.
void Kernel::note_outcome(world::TickDraft& next) {
    Stages& stage = *stages_;
    for (const world::CommandT& command : next.tick.commands) {
        if (command.kind == world::CommandKind::set_weather) {
            next.tick.weather = command.weather;
            next.tick.road_friction = command.road_friction;
        }
        if (command.kind == world::CommandKind::finish && !stage.finished) {
            stage.finished = true;
            stage.reason = command.text.empty() ? "finished" : command.text;
        }
    }
    if (!stage.finished && next.tick.index >= stage.episode.max_ticks) {
        stage.finished = true;
        stage.reason = "time limit";
    }
    if (stage.finished) {
        world::EventT event;
        event.kind = world::EventKind::finished;
        event.text = stage.reason;
        next.tick.events.push_back(event);
    }
}

bool Kernel::finished() const {
    return stages_->finished;
}

world::Outcome Kernel::outcome() const {
    using Status = world::CheckResult::Status;
    const auto all = checks();
    bool failed = false;
    for (const auto& check : all)
        failed = failed || check.status != Status::pass;
    const std::string verdict = all.empty() ? "completed" : failed ? "failed" : "passed";
    return {verdict, stages_->reason, stages_->last.view().index()};
}

std::vector<world::CheckResult> Kernel::checks() const {
    return stages_->scenario.checks();
}

void Kernel::nudge(const Nudge& nudge) {
    stages_->nudger.plan(nudge);
}

}  // namespace reprise::kernel

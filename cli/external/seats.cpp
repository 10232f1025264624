#include "cli/external/seats.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/external/wheel_program.h"
#include "cli/process/helper_program.h"
#include "cli/process/picture_memory.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

/// For the shell.
std::string render_program() {
    return fmt::format("export GLIBC_TUNABLES=\"${{GLIBC_TUNABLES-{}}}\"; exec {} live",
                       picture_memory,
                       shell_path(helper_program("reprise-render")));
}

}  // namespace

std::vector<remote::SeatPlan> parse_seats(const std::vector<std::string>& texts) {
    std::vector<remote::SeatPlan> all;
    for (const std::string& text : texts) {
        all.push_back(remote::parse_seat(text));
        if (all.back().command == keyboard_word)
            all.back().command = wheel_command();
        for (std::size_t i = 0; i + 1 < all.size(); ++i)
            if (all[i].actor == all.back().actor)
                throw world::Error(fmt::format("--driver {}: '{}' has a driver already",
                                               world::printable(text),
                                               world::printable(all[i].actor)));
    }
    return all;
}

Seats::Seats(const std::vector<std::string>& plans,
             const remote::Patience& patience,
             const world::Recording& recording)
    : recording_(&recording) {
    for (const remote::SeatPlan& plan : parse_seats(plans)) {
        free_.push_back(std::make_unique<remote::Seat>(plan, patience));
        if (const std::string place = free_.back()->place(); !place.empty())
            say(stderr, "reprise: the driver of '{}' may come to {}\n", plan.actor, place);
    }
}

void Seats::lose(const remote::Seat& seat, remote::Lost lost) {
    if (!loss_)
        loss_ =
            Loss{seat.actor(), std::move(lost.reason), lost.ours, lost.left, std::move(lost.said)};
}

/// Gives an actor the driver that was named for it, if one was.
bool Seats::seat(const world::Spawn& spawn,
                 std::uint64_t now,
                 const remote::Guide* guide,
                 const TickBytes& before) {
    const auto seat = std::find_if(free_.begin(), free_.end(), [&](const auto& one) {
        return one->actor() == spawn.command.text;
    });
    if (seat == free_.end())
        return false;
    const remote::Spawned spawned{&spawn.command,
                                  spawn.tick,
                                  now,
                                  spawn.command.rig.empty() ? std::string() : render_program(),
                                  guide,
                                  before.tick,
                                  before.traffic};
    const std::uint32_t actor = spawn.command.actor;
    if (auto lost = (*seat)->take(actor, *recording_, spawned))
        lose(**seat, std::move(*lost));
    taken_[actor] = {std::move(*seat), spawn.command.latency, now};
    free_.erase(seat);
    return true;
}

/// Drivers that wait for somebody else: a name that was typed wrong is among them.
std::string Seats::unused() const {
    std::string names;
    for (const auto& seat : free_)
        names +=
            (names.empty() ? "; there is a driver for " : ", ") + world::printable(seat->actor());
    return names;
}

void Seats::add_client(std::unique_ptr<remote::Seat> seat) {
    client_ = seat->actor();
    add(std::move(seat));
}

std::optional<std::string> Seats::somebody_driven() const {
    return taken_.empty() ? std::nullopt : std::optional(taken_.begin()->second.seat->actor());
}

void Seats::take_away(std::map<std::uint32_t, Taken>::iterator gone) {
    remote::Seat& seat = *gone->second.seat;
    if (seat.actor() == client_) {
        seat.abandon();
        client_is_without_car_ = true;
    } else {
        seat.leave("the vehicle was taken away");
    }
    taken_.erase(gone);
}

/// Who was spawned gets its driver, who was despawned loses it.
void Seats::welcome(const world::Tick& tick) {
    const world::EpisodeT& episode = recording_->episode;
    const std::string& path =
        episode.branches.empty() ? episode.scenario_path : episode.branches.back().scenario_path;
    for (const world::Command* command : *tick.commands()) {
        if (command->kind() == world::CommandKind::despawn) {
            const auto gone = taken_.find(command->actor());
            if (gone != taken_.end())
                take_away(gone);
        }
        if (command->kind() != world::CommandKind::spawn ||
            command->driver() != world::Driver::external)
            continue;
        world::Spawn spawn{{}, tick.index()};
        command->UnPackTo(&spawn.command);
        const std::string& name = spawn.command.text;
        if (!seat(spawn, tick.index()))
            throw world::Error(fmt::format(
                "{}:{}: spawn: '{}' is driven by another program: say which by --driver "
                "{}='COMMAND'{}",
                world::printable(path),
                command->line(),
                name,
                name,
                unused()));
    }
}

void Seats::go_on(const world::SealedTick& tick, const std::function<void()>& meanwhile) {
    welcome(*tick.view().tick);
    ask(tick, meanwhile);
}

void Seats::take_over(const world::ExternalDrivers& there,
                      const std::map<std::uint32_t, remote::Guide>& guides,
                      const TickBytes& before,
                      const world::SealedTick& tick) {
    for (const auto& [actor, spawn] : there.spawns()) {
        const auto told = guides.find(actor);
        seat(spawn, tick.view().index(), told == guides.end() ? nullptr : &told->second, before);
    }
    ask(tick, [] {});
}

void Seats::ask(const world::SealedTick& tick, const std::function<void()>& meanwhile) {
    controls_.clear();
    // All are shown the tick before the first is waited for: they think at the same time.
    for (const auto& [id, taken] : taken_)
        if (auto lost = loss_ ? std::nullopt : taken.seat->show(tick))
            lose(*taken.seat, std::move(*lost));
    if (!taken_.empty() && !loss_)
        meanwhile();
    const std::uint64_t now = tick.view().index();
    for (const auto& [id, taken] : taken_)
        if (auto lost = loss_ || !taken.is_due(now) ? std::nullopt : taken.seat->show_due())
            lose(*taken.seat, std::move(*lost));
    for (auto& [id, taken] : taken_) {
        if (loss_)
            return;
        if (taken.is_due(now))
            hear(taken);
        if (taken.said && !loss_)
            controls_.push_back(*taken.said);
    }
}

void Seats::hear(Taken& taken) {
    auto answer = taken.seat->answer();
    if (auto* lost = std::get_if<remote::Lost>(&answer)) {
        lose(*taken.seat, std::move(*lost));
        return;
    }
    taken.said = std::get<world::Control>(answer);
    taken.asked = taken.seat->rhythm().next(taken.asked);
}

void Seats::see_last(const world::SealedTick& tick) {
    for (const world::Command* command : *tick.view().tick->commands())
        if (command->kind() == world::CommandKind::spawn &&
            command->driver() == world::Driver::external)
            std::erase_if(free_, [&](const auto& seat) {
                return seat->actor() == command->text()->string_view();
            });
}

std::optional<remote::Frame> Seats::take_said() {
    return loss_ ? std::exchange(loss_->said, std::nullopt) : std::nullopt;
}

world::Outcome Seats::end(const world::Outcome& otherwise) {
    const auto end_of =
        loss_ && loss_->left ? world::outcome_of_left_driver : world::outcome_of_lost_driver;
    const world::Outcome outcome = loss_ ? end_of(loss_->actor, otherwise.ticks) : otherwise;
    for (const std::string& name : leave("the run ended", outcome))
        say(stderr,
            "reprise: --driver {}: nobody was spawned with that name and driver = 'external'\n",
            name);
    if (loss_ && !loss_->left)
        say(stderr,
            "reprise: {}{}\n",
            loss_->ours ? "this is our fault, please report it: " : "",
            loss_->reason);
    return outcome;
}

std::vector<std::string> Seats::leave(const std::string& reason,
                                      const std::optional<world::Outcome>& outcome) {
    for (const auto& [id, taken] : taken_)
        taken.seat->leave(reason, outcome);
    std::vector<std::string> never_came;
    for (const auto& seat : free_) {
        seat->leave(reason, outcome);
        never_came.push_back(seat->actor());
    }
    return never_came;
}

void Seats::fail(const std::string& text, std::uint32_t line) {
    for (const auto& [id, taken] : taken_)
        taken.seat->fail(text, line);
    for (const auto& seat : free_)
        seat->fail(text, line);
}

void Seats::abandon() {
    for (const auto& [id, taken] : taken_)
        taken.seat->abandon();
    for (const auto& seat : free_)
        seat->abandon();
}

}  // namespace reprise::cli

#include "cli/seats.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/process/helper_program.h"
#include "cli/process/reproduce.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

/// For the shell.
std::string render_program() {
    return "exec " + shell_path(helper_program("reprise-render")) + " live";
}

}  // namespace

Seats::Seats(const std::vector<std::string>& plans,
             const remote::Patience& patience,
             const world::Recording& recording)
    : recording_(&recording) {
    std::vector<remote::SeatPlan> all;
    for (const std::string& text : plans) {
        all.push_back(remote::parse_seat(text));
        for (std::size_t i = 0; i + 1 < all.size(); ++i)
            if (all[i].actor == all.back().actor)
                throw world::Error(
                    fmt::format("--driver {}: '{}' has a driver already", text, all[i].actor));
    }
    for (const remote::SeatPlan& plan : all)
        free_.push_back(std::make_unique<remote::Seat>(plan, patience));
}

void Seats::lose(const remote::Seat& seat, const remote::Lost& lost) {
    if (!loss_)
        loss_ = Loss{seat.actor(), lost.reason, lost.ours};
}

/// Who was spawned gets its driver, who was despawned loses it.
void Seats::welcome(const world::Tick& tick) {
    for (const world::Command* command : *tick.commands()) {
        if (command->kind() == world::CommandKind::despawn) {
            const auto gone = taken_.find(command->actor());
            if (gone != taken_.end()) {
                gone->second.seat->leave("the vehicle was taken away");
                taken_.erase(gone);
            }
        }
        if (command->kind() != world::CommandKind::spawn ||
            command->driver() != world::Driver::external)
            continue;
        const std::string name = command->text()->str();
        const auto seat = std::find_if(
            free_.begin(), free_.end(), [&](const auto& one) { return one->actor() == name; });
        if (seat == free_.end())
            throw world::Error(fmt::format(
                "{}:{}: spawn: '{}' is driven by another program: say which by --driver "
                "{}='COMMAND'",
                world::printable(recording_->episode.scenario_path),
                command->line(),
                name,
                name));
        const bool carries = command->rig() != nullptr && command->rig()->size() > 0;
        const remote::Spawned spawned{
            command, tick.index(), carries ? render_program() : std::string()};
        if (const auto lost = (*seat)->take(command->actor(), *recording_, spawned))
            lose(**seat, *lost);
        taken_[command->actor()] = {std::move(*seat), command->latency()};
        free_.erase(seat);
    }
}

void Seats::go_on(const world::SealedTick& tick) {
    controls_.clear();
    welcome(*tick.view().tick);
    // All are shown the tick before the first is waited for: they think at the same time.
    for (const auto& [id, taken] : taken_)
        if (const auto lost = loss_ ? std::nullopt : taken.seat->show(tick))
            lose(*taken.seat, *lost);
    for (const auto& [id, taken] : taken_)
        if (const auto lost =
                loss_ || taken.silent_ticks > 0 ? std::nullopt : taken.seat->show_due())
            lose(*taken.seat, *lost);
    for (auto& [id, taken] : taken_) {
        if (loss_)
            return;
        if (taken.silent_ticks > 0) {
            --taken.silent_ticks;
            continue;
        }
        const auto answer = taken.seat->answer();
        if (const auto* lost = std::get_if<remote::Lost>(&answer))
            lose(*taken.seat, *lost);
        else
            controls_.push_back(std::get<world::Control>(answer));
    }
}

std::vector<std::string> Seats::leave(const std::string& reason) {
    for (const auto& [id, taken] : taken_)
        taken.seat->leave(reason);
    std::vector<std::string> never_came;
    for (const auto& seat : free_)
        never_came.push_back(seat->actor());
    return never_came;
}

}  // namespace reprise::cli
